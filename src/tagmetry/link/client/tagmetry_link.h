/* The link of a robot with its host: what packets look like, and the robot's end of it.
 *
 * Version 1. Little-endian, packed. The table in wire.py is the source; a test compares the two.
 * Times are microseconds; `_us` of the robot is any clock that rises (micros64, esp_timer).
 * The robot keeps itself safe: call tm_command() at least every 20 ms and drive as it says.
 */
#ifndef TAGMETRY_LINK_H
#define TAGMETRY_LINK_H

#include <stdint.h>

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "the packets are little-endian, and so must the processor be"
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define TM_MAGIC 0x4D54u
#define TM_VERSION 1
#define TM_PORT 47474
#define TM_TAG_BYTES 16
#define TM_KEY_BYTES 32
#define TM_MOST_BYTES 1200
#define TM_MOST_NEIGHBOURS 100
#define TM_MOST_READINGS 64
#define TM_SILENCE_US 250000
#define TM_LATE_US 250000
#define TM_HELLO_US 200000
#define TM_RELINK_US 1000000
#define TM_TIME_US 500000
#define TM_LONGEST_COMMAND_MS 250

enum tm_kind {
    TM_HELLO = 1, TM_ASSIGN = 2, TM_TIME = 3, TM_TIME_REPLY = 4, TM_BEAT = 5, TM_ESTOP = 6,
    TM_POSE = 7, TM_NEIGHBOURS = 8, TM_COMMAND = 9, TM_ODOMETRY = 10, TM_TELEMETRY = 11,
    TM_STATE = 12, TM_ARENA = 13 /* for other computers; robots are sent none */
};

#define TM_PACKED __attribute__((packed))

typedef struct TM_PACKED {
    uint16_t magic;
    uint8_t version;
    uint8_t kind;
    uint16_t robot;
    uint16_t body_bytes;
    uint64_t sent_us;
    uint32_t counter;
    uint32_t session;
} tm_header;

typedef struct TM_PACKED { uint64_t robot_nonce, robot_us; } tm_hello;

typedef struct TM_PACKED { uint64_t robot_nonce, host_nonce, robot_us; } tm_assign;

typedef struct TM_PACKED {
    uint64_t robot_us;
    uint32_t round_trip_us, highest, received, flags;
} tm_time;

typedef struct TM_PACKED { uint64_t robot_us; } tm_time_reply;

typedef struct TM_PACKED { uint32_t edition, order; } tm_estop;

typedef struct TM_PACKED {
    uint64_t captured_us;
    float x_m, y_m, heading_rad, speed_mps, turn_rate_radps, sd_position_m, sd_heading_rad;
} tm_pose;

typedef struct TM_PACKED {
    uint64_t captured_us;
    uint16_t range_limit_mm;
    uint8_t count, omitted;
} tm_neighbours;

typedef struct TM_PACKED {
    uint16_t id, range_mm;
    int16_t bearing, heading; /* 1e-4 rad; x forward, y left, counter-clockwise */
    uint8_t age_ms, quality;
} tm_neighbour;

typedef struct TM_PACKED {
    float forward_mps, left_mps, turn_radps;
    uint16_t valid_for_ms, lamp;
} tm_command_body;

typedef struct TM_PACKED {
    uint64_t measured_us;
    float x_m, y_m, heading_rad, forward_mps, left_mps, turn_radps;
} tm_odometry;

typedef struct TM_PACKED { uint64_t measured_us; } tm_telemetry;

typedef struct TM_PACKED {
    char key[12]; /* filled up with zeros */
    float value;
} tm_reading;

typedef struct TM_PACKED {
    uint64_t moment_us;
    float x_m, y_m, heading_rad, speed_mps, turn_rate_radps, age_s;
    uint32_t flags;
    float covariance[15]; /* x, y, heading, speed, turn rate: upper triangle, row by row */
} tm_state;

typedef struct TM_PACKED {
    uint64_t moment_us;
    uint32_t image, flags;
    uint16_t robots, seen;
} tm_arena;

/* One robot's link. Read `pose`, `neighbours` and `seen`; the rest belongs to the functions. */
typedef struct {
    tm_pose pose;
    tm_neighbours neighbours;
    tm_neighbour seen[TM_MOST_NEIGHBOURS];

    uint16_t robot;
    uint8_t is_linked, is_stopped, has_asked;
    uint8_t key[TM_KEY_BYTES], session_key[TM_KEY_BYTES];
    uint64_t nonce, heard; /* bit n of heard: the counter n below the highest */
    uint32_t session, counter, highest, received, edition, round_trip_us;
    int64_t offset_us; /* host's clock minus the robot's, an upper bound */
    uint64_t offset_since_us, asked_us, heard_us, spoken_us, newest_us[TM_TELEMETRY + 1];
    tm_command_body command;
} tm_robot;

/* What the port provides: random bits from hardware or the system; they must not repeat. */
uint64_t tm_random(void);

/* Begin with the robot's id and its key of 32 bytes. */
void tm_begin(tm_robot *robot, uint16_t id, const uint8_t key[TM_KEY_BYTES]);

/* Take a packet that arrived: its kind, or 0 where it is refused. */
int tm_receive(tm_robot *robot, const uint8_t *packet, int size, uint64_t now_us);

/* Write what is due by itself (HELLO, TIME) into `out` of TM_MOST_BYTES: its size, mostly 0. */
int tm_due(tm_robot *robot, uint8_t *out, uint64_t now_us);

/* Write a packet with a body: its size; 0 while not linked or where it does not fit. */
int tm_seal(tm_robot *robot, int kind, const void *body, int body_bytes, uint8_t *out,
            uint64_t now_us);

/* The host is alive, does not hold this robot, and no emergency stop is latched. */
int tm_may_move(const tm_robot *robot, uint64_t now_us);

/* How to move now: all zeros where nothing else is granted. */
tm_command_body tm_command(const tm_robot *robot, uint64_t now_us);

/* The host's time now, never earlier than it is; only while linked. */
uint64_t tm_host_us(const tm_robot *robot, uint64_t now_us);

/* Keyed BLAKE2s (RFC 7693), `out_bytes` from 1 to 32, `key_bytes` from 0 to 32. */
void tm_blake2s(uint8_t *out, int out_bytes, const uint8_t *key, int key_bytes,
                const uint8_t *content, int size);

#ifdef __cplusplus
}
#endif
#endif
