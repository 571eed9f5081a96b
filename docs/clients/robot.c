#include <stdio.h>

#include "tagmetry_posix.h"

static void drive(tm_command_body wanted) { (void)wanted; /* set the motors here */ }

int main(int count, char **words) {
    uint8_t key[TM_KEY_BYTES] = {0};
    tm_robot robot;
    int host = count == 3 ? tm_connect(words[1], TM_PORT) : -1;
    if (host < 0 || !tm_parse_key(key, words[2])) return 2;
    tm_begin(&robot, 3, key);
    for (;;) {
        tm_step(&robot, host, 10);
        drive(tm_command(&robot, tm_now_us())); /* all zeros when the host falls silent */
        for (int i = 0; i < robot.neighbours.count; i++)
            printf("robot %d is %d mm away\n", robot.seen[i].id, robot.seen[i].range_mm);
        tm_odometry wheels = {tm_host_us(&robot, tm_now_us()), 0, 0, 0, 0, 0, 0};
        tm_send(&robot, host, TM_ODOMETRY, &wheels, sizeof wheels);
    }
}
