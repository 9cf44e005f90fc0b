// SPDX-License-Identifier: Apache-2.0
// All that most users of the library need: a mesh, the engine that cuts it, the journal and its followers, the body
// that moves, files. The headers named here can be included one by one.
#pragma once

#include "incise/core/log.h"
#include "incise/core/result.h"
#include "incise/engine/engine.h"
#include "incise/engine/simulation.h"
#include "incise/io/mesh_export.h"
#include "incise/io/mesh_file.h"
#include "incise/io/mesh_loader.h"
#include "incise/io/surface_file.h"
#include "incise/mesh/attributes.h"
#include "incise/mesh/bounds.h"
#include "incise/mesh/components.h"
#include "incise/mesh/defects.h"
#include "incise/mesh/journal_cursor.h"
#include "incise/mesh/journal_mirror.h"
#include "incise/mesh/journal_visitor.h"
#include "incise/mesh/quality_stats.h"
#include "incise/mesh/shapes.h"
#include "incise/mesh/tet_mesh.h"
#include "incise/mesh/validate.h"
#include "incise/sim/body.h"
#include "incise/version.h"
