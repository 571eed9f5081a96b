"""Folders within this one use its rendered and real pictures too: pytest adds it to the path."""
