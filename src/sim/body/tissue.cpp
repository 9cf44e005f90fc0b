// SPDX-License-Identifier: Apache-2.0
// Two tables: tissues with their numbers and which of these are readings, and words of region names, in the order in
// which they count.
#include "incise/sim/tissue.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

#include "sim/body/constants.h"

namespace incise {
inline namespace v0 {
namespace {

constexpr unsigned kE = kTissueYoung, kJ = kTissueToughness;
/// Water does not let soft tissue be compressed, which linear tets do not bear; no one measured what blades rub on.
constexpr unsigned kAlways = kTissuePoisson | kTissueFriction;

constexpr Tissue tissue(std::string_view name, double density, double young, double poisson, double toughness,
                        unsigned readings) {
  return {name, {density, young, poisson, toughness, detail::kRubbing * toughness}, readings | kAlways};
}

/// Sources, and why readings are what they are: docs/tissues.md, which a test compares with this table.
constexpr std::array<Tissue, 17> kTissues = {{
    tissue("skin", 1090, 344e3, detail::kSoftPoisson, 1136, 0),
    tissue("fat", 950, 3040, detail::kSoftPoisson, 270, kJ),
    tissue("muscle", 1050, 11.1e3, detail::kSoftPoisson, 550, kJ),
    tissue("liver", 1050, 5490, detail::kSoftPoisson, 164, 0),
    tissue("kidney", 1050, 5000, detail::kSoftPoisson, 150, kJ),
    tissue("spleen", 1040, 2900, detail::kSoftPoisson, 87, kJ),
    tissue("pancreas", 1050, 4800, detail::kSoftPoisson, 144, kJ),
    tissue("brain", 1050, 1895, detail::kSoftPoisson, 57, kJ),
    tissue("thyroid", 1040, 10.97e3, detail::kSoftPoisson, 330, kJ),
    tissue("salivary gland", 1030, 10.92e3, detail::kSoftPoisson, 330, kJ),
    tissue("breast gland", 1020, 3240, detail::kSoftPoisson, 270, kJ),
    tissue("tumour", 1050, 42e3, detail::kSoftPoisson, 330, kTissueDensity | kJ),
    tissue("heart", 1050, 11.1e3, detail::kSoftPoisson, 550, kE | kJ),
    tissue("vessel", 1060, 500e3, detail::kSoftPoisson, 290, kE),
    tissue("tendon", 1100, 51.5e3, detail::kSoftPoisson, 1136, kTissueDensity | kJ),
    tissue("cartilage", 1100, 600e3, detail::kSoftPoisson, 670, kE),
    tissue("bone", 1920, 17e9, 0.3, 600, 0),
}};

struct Word {
  std::string_view word, tissue;
};

/// Words of region names. Where a name has several, the first of this list counts.
constexpr std::array<Word, 62> kWords = {{
    {"tumor", "tumour"},
    {"tumour", "tumour"},
    {"tumors", "tumour"},
    {"tumours", "tumour"},
    {"lesion", "tumour"},
    {"metastasis", "tumour"},
    {"carcinoma", "tumour"},
    {"vessel", "vessel"},
    {"vessels", "vessel"},
    {"artery", "vessel"},
    {"arteries", "vessel"},
    {"vein", "vessel"},
    {"veins", "vessel"},
    {"vena", "vessel"},
    {"aorta", "vessel"},
    {"portal", "vessel"},
    {"cartilage", "cartilage"},
    {"cartilages", "cartilage"},
    {"cartilagenous", "cartilage"},
    {"meniscus", "cartilage"},
    {"disc", "cartilage"},
    {"tendon", "tendon"},
    {"ligament", "tendon"},
    {"ligaments", "tendon"},
    {"bone", "bone"},
    {"bones", "bone"},
    {"vertebra", "bone"},
    {"vertebrae", "bone"},
    {"rib", "bone"},
    {"ribs", "bone"},
    {"femur", "bone"},
    {"tibia", "bone"},
    {"fibula", "bone"},
    {"humerus", "bone"},
    {"scapula", "bone"},
    {"clavicula", "bone"},
    {"sternum", "bone"},
    {"sacrum", "bone"},
    {"skull", "bone"},
    {"hip", "bone"},
    {"skin", "skin"},
    {"dermis", "skin"},
    {"fat", "fat"},
    {"adipose", "fat"},
    {"subcutis", "fat"},
    {"muscle", "muscle"},
    {"muscles", "muscle"},
    {"gluteus", "muscle"},
    {"iliopsoas", "muscle"},
    {"autochthon", "muscle"},
    {"diaphragm", "muscle"},
    {"liver", "liver"},
    {"kidney", "kidney"},
    {"kidneys", "kidney"},
    {"spleen", "spleen"},
    {"pancreas", "pancreas"},
    {"brain", "brain"},
    {"cerebellum", "brain"},
    {"thyroid", "thyroid"},
    {"parotid", "salivary gland"},
    {"submandibular", "salivary gland"},
    {"heart", "heart"},
}};

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

/// Runs of letters, in lower case.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words(1);
  for (const char c : name) {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      words.back() += lower(c);
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  return words;
}

}  // namespace

std::span<const Tissue> tissues() {
  return kTissues;
}

const Tissue* find_tissue(std::string_view name) {
  const auto is_same = [&](const Tissue& t) {
    return std::equal(t.name.begin(), t.name.end(), name.begin(), name.end(),
                      [](char a, char b) { return a == lower(b); });
  };
  const auto* found = std::find_if(kTissues.begin(), kTissues.end(), is_same);
  return found == kTissues.end() ? nullptr : found;
}

const Tissue* tissue_of_region_name(std::string_view name) {
  if (const Tissue* exact = find_tissue(name)) return exact;
  const std::vector<std::string> words = words_of(name);
  for (const Word& known : kWords) {
    if (std::find(words.begin(), words.end(), known.word) != words.end()) return find_tissue(known.tissue);
  }
  return nullptr;
}

}  // namespace v0
}  // namespace incise
