"""The example counterbalance forklift: its values, its drawing, its sheet and the truth about it."""
