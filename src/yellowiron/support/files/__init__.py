"""Files as they come and go: bounded `inputs`, and folders whose files are replaced all or none (`staging`)."""
