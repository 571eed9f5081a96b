"""The published figures as the papers print them, misprints and all; each file has its source."""
