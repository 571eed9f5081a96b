"""The room where a camera finds its place by markers whose places are known."""
