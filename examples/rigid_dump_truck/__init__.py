"""The example rigid dump truck: of the Cat 773F class."""
