"""The server in a program of its own, beside the arena's: neither waits for the other."""
