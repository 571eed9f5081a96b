"""How all does: rates, delays, memory, and what to do about it in words."""
