/* Text for the serial line, sent byte by byte while the line has room. */
#ifndef LINE_H
#define LINE_H

#include <stdbool.h>
#include <stdint.h>

/* Appends to the text that waits. What does not fit is lost. */
void line_text(const char *text);
void line_number(uint32_t number);
void line_hexadecimal(uint32_t number);
void line_newtons(float force_n);

/* Sends as many bytes as the line takes now. Returns true if none waits. */
bool line_send(void);

#endif
