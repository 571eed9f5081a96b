"""Colours (blue, green, red) that people with any colour vision can tell apart.

Okabe and Ito, "Color Universal Design", 2008; the axes alone keep the red, green and blue that
everyone expects of x, y and z.
"""

Color = tuple[int, int, int]

SKY_BLUE: Color = (233, 180, 86)
ORANGE: Color = (0, 159, 230)
YELLOW: Color = (66, 228, 240)
VERMILLION: Color = (0, 94, 213)
PURPLE: Color = (167, 121, 204)
WHITE: Color = (255, 255, 255)
DARK: Color = (24, 24, 24)

AXES: tuple[Color, Color, Color] = ((48, 48, 255), (48, 200, 48), (255, 96, 32))  # x, y, z
