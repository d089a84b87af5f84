"""A motor grader."""
