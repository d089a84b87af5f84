"""What was computed before. In: a question that follows from its inputs alone. Out: its answer, made once.

`disk`: by content, kept between runs; `remembered`: for an object while it is in use.
"""
