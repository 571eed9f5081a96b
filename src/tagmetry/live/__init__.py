"""The live page: the arena in a browser, to look at and, with the token, to command."""
