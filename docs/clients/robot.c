#include <stdio.h>
#include <stdlib.h>

#include "tagmetry_posix.h"

static void drive(float forward_mps, float turn_radps) { (void)forward_mps, (void)turn_radps; }

int main(int count, char **words) { /* robot ADDRESS PORT KEY */
    uint8_t key[TM_KEY_BYTES] = {0};
    int host = count == 4 ? tm_connect(words[1], (uint16_t)atoi(words[2])) : -1;
    tm_robot robot;
    if (host < 0 || !tm_parse_key(key, words[3])) return 2;
    tm_begin(&robot, 3, key);
    for (;;) {
        tm_step(&robot, host, 10);
        tm_command_body wanted = tm_command(&robot, tm_now_us()); /* zeros if the host is gone */
        drive(wanted.forward_mps, wanted.turn_radps);
        for (int i = 0; i < robot.neighbours.count; i++)
            printf("robot %d at %d mm\n", robot.seen[i].id, robot.seen[i].range_mm);
        tm_odometry wheels = {tm_host_us(&robot, tm_now_us()), 0, 0, 0, wanted.forward_mps, 0, 0};
        tm_send(&robot, host, TM_ODOMETRY, &wheels, sizeof wheels);
    }
}
