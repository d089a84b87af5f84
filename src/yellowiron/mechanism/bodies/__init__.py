"""What moves together and what it weighs: `Placement` × `Template` × documents → `Masses`, `Body` by body.

`choice` (which document speaks for a part), `mass` (volume × density, reconciled with published weights), `body` (the
bodies and their hulls), `hidden_wheels` (bodies that no CAD part plays, under tracks that are drawn rigid).
"""
