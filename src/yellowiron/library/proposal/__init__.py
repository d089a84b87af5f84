"""A template for a machine that the library does not have: in a `FoundMachine`, out a `Proposal` of documents.

`likeness` is what another type lends, `naming` names bodies. `propose` then fills a `draft`: joint names, pins
(`hierarchy`), cylinders (`actuators`), joint entries (`joints`), motors; and says why in words (`description`).
"""
