"""One reader a format. Comes in: the path of a file; goes out: an `Assembly` in metres with what is to say of it, or a
`CadError`. Readers run in the guard's child process, by the names that `yellowiron.cad.formats` has for them.

`exact` (STEP, IGES, BREP, FreeCAD) ends in `yellowiron.cad.brep`; `meshes`, `robots` (URDF, MJCF), `usd`, `ifc`, `dxf`
and `dwg` (through `dxf`) end in `yellowiron.cad.mesh`. `robots` reads the meshes that a description names with
`meshes`; `declared` has the joints of `robots` and `usd`; `folder` reads each file with the reader of its format. Else
no reader knows another.
"""
