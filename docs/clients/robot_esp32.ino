#include <WiFi.h>
#include <WiFiUdp.h>

#include "tagmetry_link.h"

const char *NETWORK = "name of the network", *PASSWORD = "its password";
const IPAddress HOST(192, 168, 1, 5);
const uint8_t KEY[TM_KEY_BYTES] = {0x00 /* the robot's own 32 bytes */};

WiFiUDP udp;
tm_robot robot;
uint8_t packet[TM_MOST_BYTES + 1];

uint64_t tm_random(void) { return (uint64_t)esp_random() << 32 | esp_random(); }
uint64_t now_us() { return (uint64_t)esp_timer_get_time(); }
void drive(float forward_mps, float turn_radps) { /* set the motors here */ }

void transmit(int size) {
    if (size <= 0) return;
    udp.beginPacket(HOST, TM_PORT);
    udp.write(packet, size);
    udp.endPacket();
}

void setup() {
    WiFi.begin(NETWORK, PASSWORD);
    WiFi.setSleep(false); /* else packets wait for up to half a second */
    udp.begin(TM_PORT);
    tm_begin(&robot, 3, KEY); /* after WiFi: only then is esp_random() random */
}

void loop() {
    transmit(tm_due(&robot, packet, now_us()));
    while (udp.parsePacket() > 0)
        tm_receive(&robot, packet, udp.read(packet, sizeof packet), now_us());
    tm_command_body wanted = tm_command(&robot, now_us()); /* zeros if the host is gone */
    drive(wanted.forward_mps, wanted.turn_radps);
    tm_odometry wheels = {tm_host_us(&robot, now_us()), 0, 0, 0, wanted.forward_mps, 0, 0};
    transmit(tm_seal(&robot, TM_ODOMETRY, &wheels, sizeof wheels, packet, now_us()));
    delay(10);
}
