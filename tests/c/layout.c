/* SPDX-License-Identifier: Apache-2.0
 * Prints how the compiler lays the structs out: "struct size" and "struct.member offset". */
#include <stddef.h>
#include <stdio.h>

#include "incise/c/incise.h"

struct entry {
  const char* name;
  size_t value;
};

static const struct entry layout[] = {
#include "layout.inc"
};

int main(void) {
  size_t i;
  for (i = 0; i < sizeof layout / sizeof layout[0]; ++i) printf("%s %lu\n", layout[i].name, (unsigned long)layout[i].value);
  return 0;
}
