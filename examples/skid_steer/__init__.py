"""The example skid steer loader: of the Bobcat S76 class, with vertical lift; drawn with radial lift too."""
