/* SPDX-License-Identifier: Apache-2.0
 * A program that loads the library by name, as modules of Unreal do. usage: incise_c_table LIBRARY */
#include <dlfcn.h>
#include <stdio.h>

#include "../../bindings/unreal/incise_table.h"

static void* find(void* library, const char* name) {
  return dlsym(library, name);
}

static void* find_no_cuts(void* library, const char* name) {
  const char* const cut = "incise_engine_cut";
  int i = 0;
  while (name[i] != 0 && name[i] == cut[i]) ++i;
  return name[i] == cut[i] ? NULL : dlsym(library, name);
}

int main(int argc, char** argv) {
  incise_table incise;
  const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1}, normal[3] = {0, 0, 1};
  const uint32_t cells[3] = {2, 2, 2};
  incise_engine* engine = NULL;
  uint64_t before = 0, after = 0;
  void* library = argc == 2 ? dlopen(argv[1], RTLD_NOW) : NULL;
  if (!library || incise_table_load(&incise, find, library)) return 1;
  if (incise.abi() != INCISE_ABI) return 2;
  if (incise.engine_create_box(low, high, cells, NULL, &engine)) return 3;
  if (incise.engine_hash(engine, &before) || incise.engine_cut_plane(engine, normal, 0.3, NULL)) return 4;
  if (incise.engine_undo(engine, NULL) || incise.engine_hash(engine, &after) || before != after) return 5;
  if (incise.engine_free(engine)) return 6;
  if (!incise_table_load(&incise, find_no_cuts, library)) return 7;
  puts("the table works");
  return 0;
}
