"""What experiments say: their results beside the published ones."""
