"""A crawler excavator of the Komatsu PC210LC-11 class: its drawing, its sheet and the truth about both."""
