"""The server: the door, the sockets of the pages, and what waits for them."""
