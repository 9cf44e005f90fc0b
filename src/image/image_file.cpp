// SPDX-License-Identifier: Apache-2.0
// Each format is known by its first bytes and gives a header; from there on all go one way: find the voxels, unpack
// them, compare sizes, decode.
#include "incise/image/image_file.h"

#include <algorithm>
#include <new>
#include <stdexcept>

#include "image/image_header.h"
#include "image/inflate.h"
#include "image/voxel_bytes.h"
#include "incise/io/load_file.h"

namespace incise {
inline namespace v0 {
namespace image {
namespace {

namespace fs = std::filesystem;

/// Headers of text may carry much, but not more than this.
constexpr std::size_t kLongestHeader = std::size_t{1} << 20U;
constexpr io::ReadLimits kLimits = {std::uint64_t{1} << 36U};

Error bad_file(const std::string& name, const std::string& what) {
  return {ErrorCode::kBadFile, name + ": " + what};
}

Result<ImageHeader> read_header(std::string_view bytes, const std::string& name) {
  if (is_nifti(bytes)) return read_nifti_header(bytes, name);
  if (is_nrrd(bytes)) return read_nrrd_header(bytes, name);
  if (is_meta_image(bytes)) return read_meta_header(bytes, name);
  if (is_inrimage(bytes)) return read_inr_header(bytes, name);
  if (bytes.size() > 132 && bytes.substr(128, 4) == "DICM") {
    return Error{ErrorCode::kUnsupported,
                 name + ": is a DICOM file; export the segmentation as NIfTI (.nii.gz) or NRRD"};
  }
  return Error{ErrorCode::kUnsupported,
               name + ": is not a label image that Incise reads; use NIfTI (.nii, .nii.gz), NRRD or MetaImage"};
}

/// Moves the voxels' place behind lines and bytes that are to be passed over.
bool skip_what_is_before(std::string_view bytes, ImageHeader& header) {
  for (std::uint64_t l = 0; l < header.line_skip; ++l) {
    if (header.offset >= bytes.size()) return false;
    std::size_t at = static_cast<std::size_t>(header.offset);
    (void)next_line(bytes, at);
    header.offset = at;
  }
  header.offset += header.byte_skip;
  return true;
}

/// Finds the voxels in the file that has them.
Result<VoxelBytes> find_voxels(ImageHeader& header, std::string_view file, const std::string& name) {
  const std::uint64_t wanted = bytes_of(header.layout);
  if (is_gzip(file) && !header.is_deflated) {
    if (header.line_skip > 0 || header.is_at_end) return bad_file(name, "is gzipped as a whole; gunzip it first");
    return VoxelBytes(file, header.offset + header.byte_skip, name);
  }
  if (!skip_what_is_before(file, header)) return too_few(name, 0, wanted);
  if (header.is_at_end && !header.is_deflated) {
    if (file.size() < wanted) return too_few(name, file.size(), wanted);
    return VoxelBytes(file.substr(file.size() - static_cast<std::size_t>(wanted)), name);
  }
  file.remove_prefix(static_cast<std::size_t>(std::min<std::uint64_t>(header.offset, file.size())));
  return header.is_deflated ? VoxelBytes(file, 0, name) : VoxelBytes(file, name);
}

Result<ImageFile> assemble(ImageHeader header, std::string_view file, bool is_packed, const std::string& name) {
  Result<VoxelBytes> voxels = find_voxels(header, file, name);
  if (!voxels) return voxels.error();
  Result<LabelImage> image = decode(header.layout, *voxels, name);
  if (!image) return image.error();
  ImageFile out;
  out.image = std::move(image).value();
  out.format_name = header.format_name + ", " + name_of(header.layout.type) + (is_packed ? ", gzipped" : "");
  out.placed_by = header.placed_by;
  out.notes = header.notes;
  return out;
}

Result<ImageFile> read_image(std::string_view bytes, const std::string& name, const io::SiblingLoader& sibling) {
  std::string beginning, why;
  const bool is_zipped = is_gzip(bytes);
  if (is_zipped && !InflateStream(bytes).read(kLongestHeader, beginning, why)) return bad_file(name, why);
  Result<ImageHeader> header = read_header(is_zipped ? std::string_view(beginning) : bytes, name);
  if (!header) return header.error();
  if (const std::string problem = problem_of(header->layout); !problem.empty()) return bad_file(name, problem);
  if (header->data_file.empty()) return assemble(*header, bytes, is_zipped || header->is_deflated, name);
  const std::string data_file = header->data_file;
  if (!sibling) return bad_file(name, "has its voxels in " + data_file + ", which is not here; give both files");
  const Result<std::string> voxels = sibling(data_file);
  if (!voxels) return voxels.error();
  return assemble(*header, *voxels, header->is_deflated || is_gzip(*voxels), data_file);
}

/// The file of a name, or the one of that name with .gz.
fs::path present(const fs::path& path) {
  std::error_code code;
  fs::path zipped = path;
  zipped += ".gz";
  return !fs::exists(path, code) && fs::exists(zipped, code) ? zipped : path;
}

/// NIfTI's header of the voxels in an .img file.
fs::path header_of(const fs::path& path) {
  const std::string name = lower_case(path.filename().string());
  const auto ends_with = [&](std::string_view end) {
    return name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
  };
  if (ends_with(".img")) return present(fs::path(path).replace_extension(".hdr"));
  if (ends_with(".img.gz")) return present(fs::path(path).replace_extension().replace_extension(".hdr"));
  return path;
}

}  // namespace

Result<ImageFile> read_labels_bytes(std::string_view bytes, const std::string& name, const io::SiblingLoader& sibling) {
#if defined(__cpp_exceptions)
  try {
    return read_image(bytes, name, sibling);
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {
  }
  return Error{ErrorCode::kOutOfMemory, name + ": there is not enough memory for this image; use a larger machine"};
#else
  return read_image(bytes, name, sibling);
#endif
}

Result<ImageFile> read_labels(const fs::path& path) {
  const fs::path header = header_of(path);
  const Result<std::string> bytes =
      io::load_file_if(header, kLimits, [&](std::string_view beginning) -> std::optional<Error> {
        if (is_gzip(beginning)) return std::nullopt;
        const Result<ImageHeader> begun = read_header(beginning, header.string());
        if (begun || begun.error().code != ErrorCode::kUnsupported) return std::nullopt;
        return begun.error();
      });
  if (!bytes) return bytes.error();
  const io::SiblingLoader sibling = [&](const std::string& name) {
    return io::load_file(present(header.parent_path() / name), kLimits);
  };
  return read_labels_bytes(*bytes, header.string(), sibling);
}

}  // namespace image
}  // namespace v0
}  // namespace incise
