"""CAD files for tests: `step` writes assemblies with Open CASCADE, `exports` one scene in every mesh format (with `fbx`
and `blend`), `meshes` what parts become when a model's parts are merged."""
