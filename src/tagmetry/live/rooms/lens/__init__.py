"""The room where zoom and focus are driven: a marker is found, measured and followed."""
