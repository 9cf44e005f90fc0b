/* SPDX-License-Identifier: Apache-2.0
 * Cuts a cube of 750 tets along a plane, then takes the cut back: the C interface in its shortest form. */
#include <stdio.h>

#include "incise/c/incise.h"

static int fail(void) {
  fprintf(stderr, "%s\n", incise_last_error());
  return 1;
}

int main(void) {
  const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1}, normal[3] = {1, 0, 0};
  const uint32_t cells[3] = {5, 5, 5};
  incise_engine* engine = NULL;
  incise_engine_options options;
  incise_report report;
  incise_counts counts;
  uint64_t pieces = 0;

  report.size = sizeof report; /* what is written to it ends there */
  counts.size = sizeof counts;
  incise_default_engine_options(&options, sizeof options);
  options.merge = options.improve = 0; /* cut, and leave the new tets as they come */
  if (incise_engine_create_box(low, high, cells, &options, &engine)) return fail();
  if (incise_engine_cut_plane(engine, normal, 0.5, &report)) return fail();
  if (incise_engine_pieces(engine, NULL, 0, NULL, NULL, 0, &pieces)) return fail();
  if (incise_engine_counts(engine, &counts)) return fail();
  printf("Incise %s: stroke %d cut %d tets; %d tets in %d pieces\n", incise_version(), (int)report.stroke,
         (int)report.cut_tets, (int)counts.tets, (int)pieces);
  if (counts.tets != 1300 || pieces != 2) return 1;

  if (incise_engine_undo(engine, NULL) || incise_engine_counts(engine, &counts)) return fail();
  printf("Taken back: %d tets\n", (int)counts.tets);
  if (counts.tets != 750) return 1;
  return incise_engine_free(engine);
}
