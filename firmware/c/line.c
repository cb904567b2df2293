#include "line.h"

#include <stddef.h>

#include "board.h"

enum { SIZE = 512 };

static char waiting[SIZE];
static size_t end, sent;

static void put(char byte)
{
    if (end < SIZE) {
        waiting[end] = byte;
        end++;
    }
}

void line_text(const char *text)
{
    for (; *text != '\0'; text++) {
        put(*text);
    }
}

static void in_base(uint32_t number, uint32_t base, size_t digits)
{
    char text[10];
    size_t i = 0;

    for (; i < digits || number != 0U; i++) {
        text[i] = "0123456789abcdef"[number % base];
        number /= base;
    }
    while (i > 0U) {
        i--;
        put(text[i]);
    }
}

void line_number(uint32_t number)
{
    in_base(number, 10, 1);
}

void line_hexadecimal(uint32_t number)
{
    in_base(number, 16, 8);
}

void line_newtons(float force_n)
{
    const float magnitude_n = force_n < 0.0F ? -force_n : force_n;

    if (force_n <= -1.0F) {
        put('-');
    }
    line_number((uint32_t)magnitude_n);
}

bool line_send(void)
{
    while (sent < end && board_send(waiting[sent])) {
        sent++;
    }
    if (sent < end) {
        return false;
    }
    sent = 0;
    end = 0;
    return true;
}
