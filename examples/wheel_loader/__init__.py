"""A wheel loader of the Komatsu WA475-10 class: its drawing, its sheet and the truth about both."""
