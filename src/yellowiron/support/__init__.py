"""What any package may use, and what knows none of them but `model`: work in child processes (`guard`, bounded by what
`limits` has of the system), files that are whole or absent (`output`), results kept between runs (`cache`), and the
convex pieces of a mesh (`convex`, which keeps them there).
"""
