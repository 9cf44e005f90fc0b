// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "incise/core/result.h"
#include "incise/image/label_image.h"
#include "incise/io/mesh_file.h"

namespace incise {
inline namespace v0 {
namespace image {

/// A segmented scan as its file has it, placed in RAS millimetres.
struct ImageFile {
  LabelImage image;                ///< labels, and where the voxels lie
  std::string format_name;         ///< for people, for instance "NIfTI-1, 16-bit integers, gzipped"
  std::string placed_by;           ///< what said where the voxels lie, for instance "sform" or "space directions, LPS"
  std::vector<std::string> notes;  ///< what was missing or left out, in words
};

/// Read a label image; the format is found from the content, not from the name.
///
/// NIfTI-1 and NIfTI-2 (.nii, .hdr with .img), NRRD (attached and detached), MetaImage (.mha, .mhd), INRIMAGE (.inr);
/// integers of 8 to 64 bits and floating point of 32 and 64 bits, both byte orders, raw or gzipped. Values must be
/// whole numbers of 32 bits, after the scaling of the header: a segmentation, not the scan. Coordinates of NRRD and
/// MetaImage are turned from LPS to RAS. Axes of one element beyond the third are dropped.
/// @return an image of at least one voxel, with finite and independent steps.
/// Errors: `kBadFile` "FILE: what; remedy", `kUnsupported` for other formats, encodings and grey values,
/// `kOutOfMemory`. Sizes are compared with the bytes that are there before memory is taken. Cost: O(voxels), about
/// 5 ns each raw, 20 ns gzipped; holds the file's bytes and 2 bytes per voxel. Thread-safe.
/// **Source:** NIfTI-1 and NIfTI-2 headers (nifti1.h, nifti2.h); "Definition of NRRD File Format" (teem); MetaIO
/// documentation of ITK.
[[nodiscard]] Result<ImageFile> read_labels(const std::filesystem::path& path);

/// Read a label image from memory, as `read_labels` does; this is what the fuzzers call.
///
/// @param bytes    the content of a file, gzipped or not.
/// @param name     stands for FILE in messages; for .hdr it names the other half.
/// @param sibling  gets the voxels of a detached header, as they stand in the file; without it such files are refused.
[[nodiscard]] Result<ImageFile> read_labels_bytes(std::string_view bytes, const std::string& name = "image",
                                                  const io::SiblingLoader& sibling = {});

}  // namespace image
}  // namespace v0
}  // namespace incise
