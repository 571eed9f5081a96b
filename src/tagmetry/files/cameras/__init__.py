"""Camera files: one module for each format, one for what all of them share."""
