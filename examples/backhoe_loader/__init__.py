"""The example backhoe loader: of the JCB 3CX class."""
