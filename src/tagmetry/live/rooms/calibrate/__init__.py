"""The room where a camera is calibrated: guided views, the result, its report and its file."""
