/* Many robots in one program: hear the host every 2 ms, and tell it what wheels say.
 *
 *     soak_robots COUNT PORT ODOMETRY_HZ      0 tells nothing
 */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tagmetry_posix.h"

typedef struct {
    tm_robot robot;
    int host;
    uint64_t next_us;
} linked;

static void begin(linked *one, int id, uint16_t port) {
    uint8_t key[TM_KEY_BYTES];
    for (int k = 0; k < TM_KEY_BYTES; k += 2) {
        key[k] = (uint8_t)(id % 251 + 1);
        key[k + 1] = (uint8_t)(id / 251);
    }
    one->host = tm_connect("127.0.0.1", port);
    tm_begin(&one->robot, (uint16_t)id, key);
    one->next_us = tm_now_us() + (uint64_t)id * 997; /* not all at the same moment */
}

static void tell_odometry(linked *one, uint64_t period_us) {
    tm_odometry wheels;
    if (!one->robot.is_linked || tm_now_us() < one->next_us) return;
    one->next_us += period_us;
    memset(&wheels, 0, sizeof wheels);
    wheels.measured_us = tm_host_us(&one->robot, tm_now_us());
    tm_send(&one->robot, one->host, TM_ODOMETRY, &wheels, sizeof wheels);
}

int main(int words, char **word) {
    int count = words > 3 ? atoi(word[1]) : 0;
    uint64_t per_s = words > 3 ? (uint64_t)atoi(word[3]) : 0;
    linked *robots = calloc((size_t)count, sizeof *robots);
    for (int n = 0; n < count; n++) begin(&robots[n], n, (uint16_t)atoi(word[2]));
    while (count > 0) {
        for (int n = 0; n < count; n++) {
            tm_step(&robots[n].robot, robots[n].host, 0);
            if (per_s > 0) tell_odometry(&robots[n], 1000000u / per_s);
        }
        usleep(2000);
    }
    return 0;
}
