/* The controller on a desktop, which runs ticks as fast as possible. */
#include <stdio.h>
#include <stdlib.h>

#include "controller.h"

void platform_print(const char *text)
{
    if (fputs(text, stdout) == EOF) {
        exit(EXIT_FAILURE);
    }
}

int main(void)
{
    if (!controller_start()) {
        return EXIT_FAILURE;
    }
    while (!controller_finished()) {
        controller_tick();
    }
    return controller_report() ? EXIT_SUCCESS : EXIT_FAILURE;
}
