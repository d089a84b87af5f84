"""What was computed before. In: a question that follows from its inputs alone. Out: its answer, made once: by content on
disk between runs (`disk`), or for an object while it is in use (`remembered`)."""
