"""CAD files to an `Assembly`: `read_cad`."""

from yellowiron.cad.read import read_cad

__all__ = ["read_cad"]
