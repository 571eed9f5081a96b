/* The robot's end of the link: the same steps as robot.py. No heap, no sockets, no clock. */
#include "tagmetry_link.h"

#include <math.h>
#include <string.h>

#define FRAME_BYTES ((int)sizeof(tm_header) + TM_TAG_BYTES)
#define WINDOW 64

/* ---- keyed BLAKE2s: RFC 7693, section 3 ---- */

static const uint32_t IV[8] = {0x6A09E667, 0xBB67AE85, 0x3C6EF372, 0xA54FF53A,
                               0x510E527F, 0x9B05688C, 0x1F83D9AB, 0x5BE0CD19};

static const uint8_t SIGMA[10][16] = {
    {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15},
    {14, 10, 4, 8, 9, 15, 13, 6, 1, 12, 0, 2, 11, 7, 5, 3},
    {11, 8, 12, 0, 5, 2, 15, 13, 10, 14, 3, 6, 7, 1, 9, 4},
    {7, 9, 3, 1, 13, 12, 11, 14, 2, 6, 5, 10, 4, 0, 15, 8},
    {9, 0, 5, 7, 2, 4, 10, 15, 14, 1, 11, 12, 6, 8, 3, 13},
    {2, 12, 6, 10, 0, 11, 8, 3, 4, 13, 7, 5, 15, 14, 1, 9},
    {12, 5, 1, 15, 14, 13, 4, 10, 0, 7, 6, 3, 9, 2, 8, 11},
    {13, 11, 7, 14, 12, 1, 3, 9, 5, 0, 15, 4, 8, 6, 2, 10},
    {6, 15, 14, 9, 11, 3, 0, 8, 12, 2, 13, 7, 1, 4, 10, 5},
    {10, 2, 8, 4, 7, 6, 1, 5, 15, 11, 9, 14, 3, 12, 13, 0}};

static uint32_t rotated(uint32_t word, int right) {
    return word >> right | word << (32 - right);
}

static void mix(uint32_t v[16], int a, int b, int c, int d, uint32_t x, uint32_t y) {
    v[a] += v[b] + x;
    v[d] = rotated(v[d] ^ v[a], 16);
    v[c] += v[d];
    v[b] = rotated(v[b] ^ v[c], 12);
    v[a] += v[b] + y;
    v[d] = rotated(v[d] ^ v[a], 8);
    v[c] += v[d];
    v[b] = rotated(v[b] ^ v[c], 7);
}

static void compress(uint32_t h[8], const uint8_t block[64], uint32_t count, int is_last) {
    uint32_t v[16], m[16];
    memcpy(m, block, 64);
    memcpy(v, h, 32);
    memcpy(v + 8, IV, 32);
    v[12] ^= count;
    if (is_last) v[14] = ~v[14];
    for (int round = 0; round < 10; round++) {
        const uint8_t *s = SIGMA[round];
        for (int i = 0; i < 4; i++)
            mix(v, i, 4 + i, 8 + i, 12 + i, m[s[2 * i]], m[s[2 * i + 1]]);
        for (int i = 0; i < 4; i++)
            mix(v, i, 4 + (i + 1) % 4, 8 + (i + 2) % 4, 12 + (i + 3) % 4, m[s[8 + 2 * i]],
                m[s[9 + 2 * i]]);
    }
    for (int i = 0; i < 8; i++) h[i] ^= v[i] ^ v[8 + i];
}

void tm_blake2s(uint8_t *out, int out_bytes, const uint8_t *key, int key_bytes,
                const uint8_t *content, int size) {
    uint32_t h[8], count = 0;
    uint8_t block[64] = {0};
    memcpy(h, IV, 32);
    h[0] ^= 0x01010000u ^ (uint32_t)key_bytes << 8 ^ (uint32_t)out_bytes;
    if (key_bytes > 0) {
        memcpy(block, key, (size_t)key_bytes);
        count = 64;
        if (size > 0) compress(h, block, count, 0);
    }
    for (; size > 64; size -= 64, content += 64) compress(h, content, count += 64, 0);
    if (size > 0) {
        memset(block, 0, 64);
        memcpy(block, content, (size_t)size);
        count += (uint32_t)size;
    }
    compress(h, block, count, 1);
    memcpy(out, h, (size_t)out_bytes);
}

/* ---- packets ---- */

static int is_sealed(const uint8_t *key, const uint8_t *packet, int size) {
    uint8_t tag[TM_TAG_BYTES], difference = 0;
    tm_blake2s(tag, TM_TAG_BYTES, key, TM_KEY_BYTES, packet, size - TM_TAG_BYTES);
    for (int i = 0; i < TM_TAG_BYTES; i++) difference |= tag[i] ^ packet[size - TM_TAG_BYTES + i];
    return difference == 0;
}

static int seal(const tm_robot *r, const uint8_t *key, tm_header head, const void *body,
                uint8_t *out) {
    int size = (int)sizeof head + head.body_bytes;
    head.magic = TM_MAGIC;
    head.version = TM_VERSION;
    head.robot = r->robot;
    memcpy(out, &head, sizeof head);
    memcpy(out + sizeof head, body, head.body_bytes);
    tm_blake2s(out + size, TM_TAG_BYTES, key, TM_KEY_BYTES, out, size);
    return size + TM_TAG_BYTES;
}

static int fits(int kind, int body_bytes) {
    switch (kind) {
        case TM_ASSIGN: return body_bytes == sizeof(tm_assign);
        case TM_TIME_REPLY: return body_bytes == sizeof(tm_time_reply);
        case TM_BEAT: return body_bytes == 0;
        case TM_ESTOP: return body_bytes == sizeof(tm_estop);
        case TM_POSE: return body_bytes == sizeof(tm_pose);
        case TM_NEIGHBOURS: return body_bytes >= (int)sizeof(tm_neighbours);
        case TM_COMMAND: return body_bytes == sizeof(tm_command_body);
        default: return 0; /* also what only robots send */
    }
}

/* ---- replay: RFC 4303, section 3.4.3 ---- */

static int is_new(const tm_robot *r, uint32_t counter) {
    uint32_t back = r->highest - counter;
    return counter > r->highest || (counter > 0 && back < WINDOW && !(r->heard >> back & 1));
}

static void remember(tm_robot *r, uint32_t counter) {
    if (counter > r->highest) {
        uint32_t ahead = counter - r->highest;
        r->heard = (ahead < WINDOW ? r->heard << ahead : 0) | 1;
        r->highest = counter;
    } else {
        r->heard |= (uint64_t)1 << (r->highest - counter);
    }
    r->received++;
}

/* ---- the host's time: at most its reply, plus what has passed since the question ---- */

static int64_t bound_us(const tm_robot *r, uint64_t now_us) {
    return r->offset_us + (int64_t)(now_us - r->offset_since_us) / 5000; /* 200 ppm of drift */
}

uint64_t tm_host_us(const tm_robot *r, uint64_t now_us) {
    return now_us + (uint64_t)bound_us(r, now_us);
}

static int is_late(uint64_t sent_us, uint64_t now_us) {
    return (now_us > sent_us ? now_us - sent_us : sent_us - now_us) > TM_LATE_US;
}

static int is_recent(uint64_t asked_us, uint64_t now_us) {
    return now_us >= asked_us && now_us - asked_us <= TM_LATE_US;
}

/* ---- what a packet says ---- */

static int receive_assign(tm_robot *r, const uint8_t *packet, int size, const tm_header *head,
                          uint64_t now_us) {
    tm_assign assign;
    memcpy(&assign, packet + sizeof *head, sizeof assign);
    if (r->is_linked || !is_sealed(r->key, packet, size)) return 0;
    if (assign.robot_nonce != r->nonce || !is_recent(assign.robot_us, now_us)) return 0;
    uint64_t nonces[2] = {r->nonce, assign.host_nonce};
    tm_blake2s(r->session_key, TM_KEY_BYTES, r->key, TM_KEY_BYTES, (const uint8_t *)nonces, 16);
    r->session = (uint32_t)assign.host_nonce;
    r->offset_us = (int64_t)(head->sent_us - assign.robot_us);
    r->offset_since_us = r->heard_us = now_us;
    r->round_trip_us = (uint32_t)(now_us - assign.robot_us);
    r->heard = r->spoken_us = 0;
    r->counter = r->highest = r->received = r->edition = 0;
    r->has_asked = 0;
    memset(r->newest_us, 0, sizeof r->newest_us);
    memset(&r->command, 0, sizeof r->command);
    memset(&r->neighbours, 0, sizeof r->neighbours);
    r->is_linked = 1;
    return TM_ASSIGN;
}

static int makes_sense(const tm_header *head, const uint8_t *body) {
    float values[7];
    int first = head->kind == TM_POSE ? 8 : 0, count = head->kind == TM_POSE ? 7 : 3;
    if (head->kind == TM_NEIGHBOURS) {
        tm_neighbours list;
        memcpy(&list, body, sizeof list);
        return list.count <= TM_MOST_NEIGHBOURS &&
               head->body_bytes == sizeof list + list.count * sizeof(tm_neighbour);
    }
    if (head->kind != TM_POSE && head->kind != TM_COMMAND) return 1;
    memcpy(values, body + first, (size_t)count * sizeof(float));
    for (int i = 0; i < count; i++)
        if (!isfinite(values[i])) return 0;
    return 1;
}

static void take_estop(tm_robot *r, const uint8_t *body) {
    tm_estop estop;
    memcpy(&estop, body, sizeof estop);
    if (estop.edition < r->edition) return;
    r->edition = estop.edition;
    if (estop.order == 1 || estop.order == 2) r->is_stopped = estop.order == 1;
}

static void take_time(tm_robot *r, const uint8_t *body, uint64_t sent_us, uint64_t now_us) {
    tm_time_reply reply;
    memcpy(&reply, body, sizeof reply);
    if (!is_recent(reply.robot_us, now_us)) return;
    int64_t kept = bound_us(r, now_us), fresh = (int64_t)(sent_us - reply.robot_us);
    r->offset_us = fresh < kept ? fresh : kept;
    r->offset_since_us = now_us;
    r->round_trip_us = (uint32_t)(now_us - reply.robot_us);
}

static void obey(tm_robot *r, const tm_header *head, const uint8_t *body, uint64_t now_us) {
    if (head->kind == TM_ESTOP) take_estop(r, body);
    if (head->kind == TM_TIME_REPLY) take_time(r, body, head->sent_us, now_us);
    if (head->sent_us < r->newest_us[head->kind]) return; /* overtaken by a newer one */
    r->newest_us[head->kind] = head->sent_us;
    if (head->kind == TM_COMMAND) memcpy(&r->command, body, sizeof r->command);
    if (head->kind == TM_POSE) memcpy(&r->pose, body, sizeof r->pose);
    if (head->kind == TM_NEIGHBOURS) {
        memcpy(&r->neighbours, body, sizeof r->neighbours);
        memcpy(r->seen, body + sizeof r->neighbours, r->neighbours.count * sizeof(tm_neighbour));
    }
}

int tm_receive(tm_robot *r, const uint8_t *packet, int size, uint64_t now_us) {
    tm_header head;
    if (size < FRAME_BYTES || size > TM_MOST_BYTES) return 0;
    memcpy(&head, packet, sizeof head);
    if (head.magic != TM_MAGIC || head.version != TM_VERSION || head.robot != r->robot) return 0;
    if (head.body_bytes != size - FRAME_BYTES || !fits(head.kind, head.body_bytes)) return 0;
    if (head.kind == TM_ASSIGN) return receive_assign(r, packet, size, &head, now_us);
    if (!r->is_linked || head.session != r->session || !is_new(r, head.counter)) return 0;
    if (!is_sealed(r->session_key, packet, size)) return 0;
    if (is_late(head.sent_us, tm_host_us(r, now_us))) return 0;
    if (!makes_sense(&head, packet + sizeof head)) return 0;
    remember(r, head.counter);
    r->heard_us = now_us;
    if (head.kind != TM_TIME_REPLY && head.kind != TM_ESTOP && head.sent_us > r->spoken_us)
        r->spoken_us = head.sent_us; /* those two are no sign that the host's program lives */
    obey(r, &head, packet + sizeof head, now_us);
    return head.kind;
}

/* ---- what the robot does ---- */

void tm_begin(tm_robot *r, uint16_t id, const uint8_t key[TM_KEY_BYTES]) {
    memset(r, 0, sizeof *r);
    r->robot = id;
    memcpy(r->key, key, TM_KEY_BYTES);
    r->nonce = tm_random();
}

int tm_seal(tm_robot *r, int kind, const void *body, int body_bytes, uint8_t *out,
            uint64_t now_us) {
    tm_header head = {0};
    if (!r->is_linked || r->counter == UINT32_MAX) return 0;
    if (body_bytes < 0 || body_bytes > TM_MOST_BYTES - FRAME_BYTES) return 0;
    head.kind = (uint8_t)kind;
    head.body_bytes = (uint16_t)body_bytes;
    head.sent_us = tm_host_us(r, now_us);
    head.counter = ++r->counter;
    head.session = r->session;
    return seal(r, r->session_key, head, body, out);
}

static int seal_hello(const tm_robot *r, uint8_t *out, uint64_t now_us) {
    tm_header head = {0};
    tm_hello hello = {r->nonce, now_us};
    head.kind = TM_HELLO;
    head.body_bytes = sizeof hello;
    return seal(r, r->key, head, &hello, out);
}

int tm_due(tm_robot *r, uint8_t *out, uint64_t now_us) {
    if (r->is_linked && (now_us - r->heard_us > TM_RELINK_US || r->counter == UINT32_MAX)) {
        r->is_linked = r->has_asked = 0;
        r->nonce = tm_random();
    }
    if (r->has_asked && now_us - r->asked_us < (r->is_linked ? TM_TIME_US : TM_HELLO_US)) return 0;
    r->has_asked = 1;
    r->asked_us = now_us;
    if (!r->is_linked) return seal_hello(r, out, now_us);
    tm_time time = {now_us, r->round_trip_us, r->highest, r->received, r->is_stopped};
    return tm_seal(r, TM_TIME, &time, sizeof time, out, now_us);
}

int tm_may_move(const tm_robot *r, uint64_t now_us) {
    int64_t host_us = (int64_t)tm_host_us(r, now_us);
    int is_held = r->newest_us[TM_COMMAND] > 0 && r->command.valid_for_ms == 0 &&
                  host_us - (int64_t)r->newest_us[TM_COMMAND] <= TM_SILENCE_US;
    if (!r->is_linked || r->spoken_us == 0 || r->is_stopped || is_held) return 0;
    return host_us - (int64_t)r->spoken_us <= TM_SILENCE_US;
}

tm_command_body tm_command(const tm_robot *r, uint64_t now_us) {
    static const tm_command_body still = {0};
    int64_t age_us = (int64_t)(tm_host_us(r, now_us) - r->newest_us[TM_COMMAND]);
    int64_t longest_ms = r->command.valid_for_ms;
    if (longest_ms > TM_LONGEST_COMMAND_MS) longest_ms = TM_LONGEST_COMMAND_MS;
    return tm_may_move(r, now_us) && age_us < 1000 * longest_ms ? r->command : still;
}
