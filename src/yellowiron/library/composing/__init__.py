"""What a template is put together from: the documents of types that it is like, and modules, which stand once.

In: a template's folder; out: its documents, each whole, as if written out. `layers` puts values on top of each other,
`modules` says what uses of modules come to, `documents` does both for a folder, `new` writes one of a few lines.
"""
