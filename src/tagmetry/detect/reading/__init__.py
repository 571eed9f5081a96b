"""From squares to the markers that they show.

sample (grey between pixels) -> spots (cells of each square) -> decode (what reads black and white)
-> nearest (of which marker: closest compares all codes, shelves those that may be meant).
"""
