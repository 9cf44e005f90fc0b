/* SPDX-License-Identifier: Apache-2.0
 * Prints the hash that a blade's steps through a body leave, and what each step costs from C, in CPU ms: the least of
 * several rounds of one stroke. usage: incise_c_step_cost MESH|- ROUNDS STEPS     -: a box of 10,368 tets */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "incise/c/incise.h"

struct box {
  double low[3], high[3];
};

static int open_body(const char* path, incise_engine** engine) {
  const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
  const uint32_t cells[3] = {12, 12, 12};
  if (strcmp(path, "-") != 0) return incise_engine_read(path, NULL, engine);
  return incise_engine_create_box(low, high, cells, NULL, engine);
}

static int find_bounds(const incise_engine* engine, struct box* bounds) {
  incise_view view;
  const double* points;
  uint64_t i;
  int k;
  view.size = sizeof view;
  if (incise_engine_view(engine, INCISE_REST, &view) || view.rows == 0) return 1;
  points = (const double*)view.data;
  for (k = 0; k < 3; ++k) bounds->low[k] = bounds->high[k] = points[k];
  for (i = 0; i < view.rows; ++i) {
    for (k = 0; k < 3; ++k) {
      const double x = points[3 * i + k];
      if (x < bounds->low[k]) bounds->low[k] = x;
      if (x > bounds->high[k]) bounds->high[k] = x;
    }
  }
  return 0;
}

/* Where the edge is at `share` of its way down through the body, a little aslant. */
static void place(const struct box* b, double share, double edge[6]) {
  const double x = 0.5 * (b->low[0] + b->high[0]), width = b->high[0] - b->low[0];
  const double y = b->high[1] - b->low[1], z = b->high[2] - b->low[2];
  edge[0] = x - 0.02 * width;
  edge[3] = x + 0.03 * width;
  edge[1] = b->low[1] - 0.1 * y;
  edge[4] = b->high[1] + 0.1 * y;
  edge[2] = edge[5] = b->high[2] + 0.05 * z - 1.1 * share * z;
}

/* Keeps in `least` what is less there for each step. */
static int cut_once(incise_engine* engine, const struct box* bounds, int steps, double* least, uint64_t* hash) {
  double edge[6];
  incise_report report;
  int i;
  report.size = sizeof report;
  place(bounds, 0, edge);
  if (incise_engine_begin_stroke(engine, edge, 2, NULL, NULL)) return 1;
  for (i = 1; i <= steps; ++i) {
    const clock_t began = clock();
    double ms;
    place(bounds, (double)i / steps, edge);
    if (incise_engine_step(engine, edge, 2, NULL, &report)) return 1;
    ms = 1e3 * (double)(clock() - began) / CLOCKS_PER_SEC;
    if (ms < least[i - 1]) least[i - 1] = ms;
  }
  if (incise_engine_end_stroke(engine, NULL) || incise_engine_hash(engine, hash)) return 1;
  return incise_engine_undo(engine, NULL);
}

int main(int argc, char** argv) {
  incise_engine* engine = NULL;
  struct box bounds;
  double* least = NULL;
  uint64_t hash = 0;
  int round, steps, i;
  if (argc != 4 || (steps = atoi(argv[3])) < 1) return 2;
  least = malloc((size_t)steps * sizeof *least);
  if (least == NULL) return 1;
  for (i = 0; i < steps; ++i) least[i] = 1e30;
  if (open_body(argv[1], &engine) || find_bounds(engine, &bounds)) goto failed;
  for (round = 0; round < atoi(argv[2]); ++round) {
    if (cut_once(engine, &bounds, steps, least, &hash)) goto failed;
  }
  printf("%08lx%08lx\n", (unsigned long)(hash >> 32), (unsigned long)(hash & 0xFFFFFFFFu));
  for (i = 0; i < steps; ++i) printf("%.4f\n", least[i]);
  free(least);
  return incise_engine_free(engine);
failed:
  fprintf(stderr, "%s\n", incise_last_error());
  return 1;
}
