"""What experiments are set up with: cameras, boards, markers and places of the papers."""
