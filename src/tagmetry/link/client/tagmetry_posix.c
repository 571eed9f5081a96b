#define _POSIX_C_SOURCE 200112L
#include "tagmetry_posix.h"

#include <arpa/inet.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

static uint64_t held_us;
static int is_held;

void tm_hold_clock(uint64_t now_us) {
    held_us = now_us;
    is_held = 1;
}

uint64_t tm_now_us(void) {
    struct timespec now;
    if (is_held) return held_us;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000u + (uint64_t)now.tv_nsec / 1000u;
}

uint64_t tm_random(void) {
    uint64_t bits = 0;
    FILE *source = fopen("/dev/urandom", "rb");
    if (source == NULL || fread(&bits, sizeof bits, 1, source) != 1) abort();
    fclose(source);
    return bits;
}

int tm_connect(const char *address, uint16_t port) {
    struct sockaddr_in host;
    int connection = socket(AF_INET, SOCK_DGRAM, 0);
    memset(&host, 0, sizeof host);
    host.sin_family = AF_INET;
    host.sin_port = htons(port);
    if (connection < 0) return -1;
    if (inet_pton(AF_INET, address, &host.sin_addr) == 1 &&
        connect(connection, (struct sockaddr *)&host, sizeof host) == 0)
        return connection;
    close(connection);
    return -1;
}

int tm_step(tm_robot *robot, int connection, int timeout_ms) {
    uint8_t packet[TM_MOST_BYTES + 1];
    struct pollfd waiting = {connection, POLLIN, 0};
    int accepted = 0, size = tm_due(robot, packet, tm_now_us());
    if (size > 0) (void)!send(connection, packet, (size_t)size, 0); /* a lost one is tried again */
    for (int wait_ms = timeout_ms; poll(&waiting, 1, wait_ms) > 0; wait_ms = 0) {
        size = (int)recv(connection, packet, sizeof packet, 0);
        if (size < 0) break; /* nobody listens at the host's port just now */
        accepted += tm_receive(robot, packet, size, tm_now_us()) != 0;
    }
    return accepted;
}

int tm_send(tm_robot *robot, int connection, int kind, const void *body, int body_bytes) {
    uint8_t packet[TM_MOST_BYTES];
    int size = tm_seal(robot, kind, body, body_bytes, packet, tm_now_us());
    return size > 0 && send(connection, packet, (size_t)size, 0) == size;
}

int tm_parse_key(uint8_t key[TM_KEY_BYTES], const char *text) {
    static const char digits[] = "0123456789abcdef";
    if (strlen(text) != 2 * TM_KEY_BYTES) return 0;
    for (int i = 0; i < 2 * TM_KEY_BYTES; i++) {
        const char *digit = strchr(digits, text[i] | 0x20);
        if (digit == NULL) return 0;
        key[i / 2] = (uint8_t)(key[i / 2] << 4 | (digit - digits));
    }
    return 1;
}
