"""The vocabulary: frozen dataclasses every stage speaks. Metres, kilograms, seconds, radians."""
