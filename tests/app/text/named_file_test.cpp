// SPDX-License-Identifier: Apache-2.0
// Where files are found that others name, with folders and without.
#include "app/text/named_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "support/folder.h"

namespace named_file_test {
namespace {

using incise::app::find_named;

TEST(NamedFile, is_found_by_its_last_part_only_where_files_come_alone) {
  const incise_test::Folder folder;
  const std::filesystem::path place = std::filesystem::path(folder / "x").parent_path(),
                              mesh = folder.write("x.mesh", "");
  for (const char* name : {"../models/x.mesh", "/home/me/x.mesh", "C:\\data\\x.mesh", "models/x.mesh"}) {
    EXPECT_EQ(find_named(place, name, true), mesh) << name;
    EXPECT_EQ(find_named(place, name), std::nullopt) << name;
  }
  EXPECT_EQ(find_named(place, "x.mesh"), mesh);
  EXPECT_EQ(find_named("elsewhere", mesh.string()), mesh);
  for (const char* name : {"../y.mesh", "nowhere/", "C:\\"}) {
    EXPECT_EQ(find_named(place, name, true), std::nullopt) << name;
  }
}

}  // namespace
}  // namespace named_file_test
