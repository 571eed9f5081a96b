"""Being here, it lets tests in the folders below import what lies beside it."""
