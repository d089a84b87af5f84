"""The example articulated dump truck: of the Cat 740 GC class."""
