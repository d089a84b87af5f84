"""The example wheeled excavator: a JCB JS160W with a mono boom, single tyres and stabilisers at the rear."""
