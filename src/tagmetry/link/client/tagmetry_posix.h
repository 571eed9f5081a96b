/* The link on computers with plain sockets: Linux, macOS, Raspberry Pi. */
#ifndef TAGMETRY_POSIX_H
#define TAGMETRY_POSIX_H

#include "tagmetry_link.h"

/* A clock that only rises, in microseconds. */
uint64_t tm_now_us(void);

/* From now on the clock stands still between calls of this: for simulations. */
void tm_hold_clock(uint64_t now_us);

/* A socket to the host at an IPv4 address, or -1. */
int tm_connect(const char *address, uint16_t port);

/* Wait for packets, at most so long, take all, and send what is due: how many were accepted. */
int tm_step(tm_robot *robot, int connection, int timeout_ms);

/* Send a packet with a body; 0 while not linked. */
int tm_send(tm_robot *robot, int connection, int kind, const void *body, int body_bytes);

/* Read a key of 64 hexadecimal digits: 1, or 0 where it is none. */
int tm_parse_key(uint8_t key[TM_KEY_BYTES], const char *text);

#endif
