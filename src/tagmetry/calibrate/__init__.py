"""Views of a board to a camera with its covariance, and what that camera is good for."""
