"""What stands behind the page's rooms: a folder for each, with what answers its requests."""
