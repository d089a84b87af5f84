"""What the example machines are drawn with: solids, product trees, standard parts, cylinders, STEP files."""
