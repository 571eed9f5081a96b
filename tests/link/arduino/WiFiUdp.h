#pragma once
#include "WiFi.h"

struct WiFiUDP {
    void begin(int) {}
    void beginPacket(IPAddress, int) {}
    void write(const uint8_t *, std::size_t) {}
    void endPacket() {}
    int parsePacket() { return 0; }
    int read(uint8_t *, std::size_t) { return 0; }
};
