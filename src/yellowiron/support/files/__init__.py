"""Files as they come and go: bounded `inputs`, what guarded children write (`answers`), and folders whose files are
replaced all or none (`staging`)."""
