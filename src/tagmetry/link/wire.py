"""What every packet is, byte by byte: the table that all else follows.

A packet is a header, a body and a tag, all little-endian and packed. The C header beside the client
says the same, and a test compares the two with a compiler; the page of the protocol is written from
here.
"""

from tagmetry.link.layout import COVARIANCES, KEY_CHARACTERS, Body, Field, Kind, Layout

MAGIC = 0x4D54  # the bytes `TM`
VERSION = 1
PORT = 47474
TAG_BYTES = 16
KEY_BYTES = 32
MOST_BYTES = 1200  # fits every network without being split
SILENCE_US = 250_000  # a robot that heard nothing sent later than this long ago stands still
LATE_US = 250_000  # an older packet is refused
BEAT_US = 50_000  # the host is never silent for longer
HELLO_US = 200_000  # between two attempts to be assigned
RELINK_US = 1_000_000  # after so long a silence a robot begins anew
TIME_US = 500_000  # between two measurements of the round trip
LONGEST_COMMAND_MS = 250  # a command lives no longer, whatever it says

HEADER = Layout(
    "header",
    (
        Field("magic", "uint16_t", "0x4D54, the bytes `TM`"),
        Field("version", "uint8_t", "1"),
        Field("kind", "uint8_t", "which body follows"),
        Field("robot", "uint16_t", "the robot's id, both ways"),
        Field("body_bytes", "uint16_t", "size of the body"),
        Field("sent_us", "uint64_t", "when it was sent, in the host's clock"),
        Field("counter", "uint32_t", "rises by one with every packet of a session and sender"),
        Field("session", "uint32_t", "lower half of the host's nonce; 0 in HELLO and ASSIGN"),
    ),
)

NEIGHBOUR = Layout(
    "neighbour",
    (
        Field("id", "uint16_t", "the neighbour"),
        Field("range_mm", "uint16_t", "its distance, centre to centre"),
        Field("bearing", "int16_t", "1e-4 rad from the robot's x (forward) to y (left)"),
        Field("heading", "int16_t", "1e-4 rad, its heading minus the robot's"),
        Field("age_ms", "uint8_t", "since it was last seen; 255: longer"),
        Field("quality", "uint8_t", "0 to 255"),
    ),
)
READING = Layout(
    "reading",
    (
        Field("key", f"char[{KEY_CHARACTERS}]", "ASCII, filled up with zeros"),
        Field("value", "float", "may be NaN"),
    ),
)
_CAPTURED = Field("captured_us", "uint64_t", "when the image was taken, in the host's clock")

BODIES: dict[Kind, Body] = {
    body.kind: body
    for body in (
        Body(
            Kind.HELLO,
            "robot",
            Layout(
                "hello",
                (
                    Field("robot_nonce", "uint64_t", "random, new for every attempt to link"),
                    Field("robot_us", "uint64_t", "the robot's own clock"),
                ),
            ),
            "A robot wants a session; sealed with its key.",
        ),
        Body(
            Kind.ASSIGN,
            "host",
            Layout(
                "assign",
                (
                    Field("robot_nonce", "uint64_t", "as in the HELLO that it answers"),
                    Field("host_nonce", "uint64_t", "random, new for every session"),
                    Field("robot_us", "uint64_t", "as in the HELLO"),
                ),
            ),
            "The session begins; sealed with the robot's key, all that follows with the session's.",
        ),
        Body(
            Kind.TIME,
            "robot",
            Layout(
                "time",
                (
                    Field("robot_us", "uint64_t", "the robot's own clock"),
                    Field("round_trip_us", "uint32_t", "the last one measured; 0: none yet"),
                    Field("highest", "uint32_t", "highest counter heard from the host"),
                    Field("received", "uint32_t", "packets accepted in this session"),
                    Field("flags", "uint32_t", "bit 0: the emergency stop is latched"),
                ),
            ),
            "Asks for the host's time, and tells how well the robot hears.",
        ),
        Body(
            Kind.TIME_REPLY,
            "host",
            Layout("time_reply", (Field("robot_us", "uint64_t", "as in the TIME it answers"),)),
            "The host's time is the header's `sent_us`.",
        ),
        Body(
            Kind.BEAT,
            "host",
            Layout("beat", ()),
            "The host and its program are alive; it is never silent for more than 50 ms.",
        ),
        Body(
            Kind.ESTOP,
            "host",
            Layout(
                "estop",
                (
                    Field("edition", "uint32_t", "rises with every change; an older one is void"),
                    Field("order", "uint32_t", "1: stop and stay stopped; 2: release"),
                ),
            ),
            "Emergency stop, repeated every 25 ms while it holds; the release 20 times.",
        ),
        Body(
            Kind.POSE,
            "host",
            Layout(
                "pose",
                (
                    _CAPTURED,
                    Field("x_m", "float", "the robot in the world"),
                    Field("y_m", "float", "the robot in the world"),
                    Field("heading_rad", "float", "from the world's x, counter-clockwise"),
                    Field("speed_mps", "float", "forward"),
                    Field("turn_rate_radps", "float", "counter-clockwise"),
                    Field("sd_position_m", "float", "standard deviation, the larger of x and y"),
                    Field("sd_heading_rad", "float", "standard deviation"),
                ),
            ),
            "Where the robot is.",
        ),
        Body(
            Kind.NEIGHBOURS,
            "host",
            Layout(
                "neighbours",
                (
                    _CAPTURED,
                    Field("range_limit_mm", "uint16_t", "how far the emulated sensor reaches"),
                    Field("count", "uint8_t", "how many follow"),
                    Field("omitted", "uint8_t", "how many more there were than fit"),
                ),
            ),
            "What a sensor of limited range on the robot would see.",
            NEIGHBOUR,
        ),
        Body(
            Kind.COMMAND,
            "host",
            Layout(
                "command",
                (
                    Field("forward_mps", "float", "velocity along the robot's x"),
                    Field("left_mps", "float", "velocity along its y"),
                    Field("turn_radps", "float", "counter-clockwise"),
                    Field("valid_for_ms", "uint16_t", "from `sent_us`, 250 at most; 0: held"),
                    Field("lamp", "uint16_t", "brightness of a lamp, 0 to 65535"),
                ),
            ),
            "How to move, for a while; then it stands still. Held, it may not steer itself either.",
        ),
        Body(
            Kind.ODOMETRY,
            "robot",
            Layout(
                "odometry",
                (
                    Field("measured_us", "uint64_t", "in the host's clock"),
                    Field("x_m", "float", "in a frame of the robot's own"),
                    Field("y_m", "float", "in a frame of the robot's own"),
                    Field("heading_rad", "float", "in that frame"),
                    Field("forward_mps", "float", "velocity along the robot's x"),
                    Field("left_mps", "float", "velocity along its y"),
                    Field("turn_radps", "float", "counter-clockwise"),
                ),
            ),
            "What the robot's wheels say.",
        ),
        Body(
            Kind.TELEMETRY,
            "robot",
            Layout("telemetry", (Field("measured_us", "uint64_t", "in the host's clock"),)),
            "Numbers by name, whatever the robot wants to tell.",
            READING,
        ),
        Body(
            Kind.STATE,
            "arena",
            Layout(
                "state",
                (
                    Field("moment_us", "uint64_t", "when the robot is there, in the host's clock"),
                    Field("x_m", "float", "the robot in the world"),
                    Field("y_m", "float", "the robot in the world"),
                    Field("heading_rad", "float", "from the world's x, counter-clockwise"),
                    Field("speed_mps", "float", "forward"),
                    Field("turn_rate_radps", "float", "counter-clockwise"),
                    Field("age_s", "float", "since an image showed it, at that moment"),
                    Field("flags", "uint32_t", "bit 0: the image shows it; 1: it must stand still"),
                    Field(
                        "covariance",
                        f"float[{COVARIANCES}]",
                        "of x, y, heading, speed, turn rate: upper triangle, row by row",
                    ),
                ),
            ),
            "Where a robot is and how sure that is, for other computers.",
        ),
        Body(
            Kind.ARENA,
            "arena",
            Layout(
                "arena",
                (
                    Field("moment_us", "uint64_t", "as in the states that it follows"),
                    Field("image", "uint32_t", "counts the images"),
                    Field("flags", "uint32_t", "bit 0: the stop for all is pressed"),
                    Field("robots", "uint16_t", "how many states belong to the image"),
                    Field("seen", "uint16_t", "how many of these robots the image shows"),
                ),
            ),
            "All of one image was told.",
        ),
    )
}
FRAME_BYTES = HEADER.size_bytes + TAG_BYTES
MOST_NEIGHBOURS = 100
MOST_READINGS = 64
