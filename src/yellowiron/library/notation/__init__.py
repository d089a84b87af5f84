"""How documents are written: JSON, numbers and keys, whatever the document.

In: a file's path, or the text of a value. Out: `validated_json.Document`, JSON that fits its schema and says file and
key of every value; `quantities`, numbers in SI; `role_keys`, entries by role. Each errs with a `TemplateError`.
`role_keys` builds on `validated_json`; `quantities` on neither.
"""
