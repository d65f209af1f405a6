#include "imaging/results/segment_meaning.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace tidemark::imaging {
namespace {

std::vector<NamedMeaning> make_meanings() {
  const auto sct = [](const char* value, const char* meaning) { return Code{value, "SCT", meaning}; };
  const Code structure = SegmentMeaning().category;
  const Code tissue = sct("85756007", "Tissue");
  const Code abnormal = sct("49755003", "Morphologically Abnormal Structure");
  const Code substance = sct("91720002", "Body Substance");
  return {
      {"tissue", SegmentMeaning()},
      {"aneurysm", {abnormal, sct("85659009", "Aneurysm")}},
      {"aorta", {structure, sct("15825003", "Aorta")}},
      {"artery", {tissue, sct("51114001", "Artery")}},
      {"bladder", {structure, sct("89837001", "Bladder")}},
      {"bone", {structure, sct("272673000", "Bone")}},
      {"brain", {structure, sct("12738006", "Brain")}},
      {"brain-ventricle", {structure, sct("35764002", "Brain Ventricle")}},
      {"breast", {structure, sct("76752008", "Breast")}},
      {"cerebrospinal-fluid", {substance, sct("65216001", "Cerebrospinal Fluid")}},
      {"colon", {structure, sct("71854001", "Colon")}},
      {"cyst", {abnormal, sct("367643001", "Cyst")}},
      {"femur", {structure, sct("71341001", "Femur")}},
      {"gallbladder", {structure, sct("28231008", "Gallbladder")}},
      {"grey-matter", {tissue, sct("389081007", "Gray Matter")}},
      {"haematoma", {abnormal, sct("35566002", "Hematoma")}},
      {"heart", {structure, sct("80891009", "Heart")}},
      {"hippocampus", {structure, sct("5366008", "Hippocampus")}},
      {"kidney", {structure, sct("64033007", "Kidney")}},
      {"lesion", {abnormal, sct("52988006", "Lesion")}},
      {"liver", {structure, sct("10200004", "Liver")}},
      {"lung", {structure, sct("39607008", "Lung")}},
      {"lymph-node", {structure, sct("59441001", "Lymph node")}},
      {"metastasis", {abnormal, sct("14799000", "Neoplasm, Secondary")}},
      {"muscle", {structure, sct("71616004", "Muscle")}},
      {"necrosis", {abnormal, sct("6574001", "Necrosis")}},
      {"nodule", {abnormal, sct("27925004", "Nodule")}},
      {"oedema", {abnormal, sct("79654002", "Edema")}},
      {"pancreas", {structure, sct("15776009", "Pancreas")}},
      {"prostate", {structure, sct("41216001", "Prostate")}},
      {"skull", {structure, sct("89546000", "Skull")}},
      {"spinal-cord", {structure, sct("2748008", "Spinal cord")}},
      {"spleen", {structure, sct("78961009", "Spleen")}},
      {"stomach", {structure, sct("69695003", "Stomach")}},
      {"thrombus", {abnormal, sct("396339007", "Thrombus")}},
      {"tumour", {abnormal, sct("108369006", "Neoplasm")}},
      {"uterus", {structure, sct("35039007", "Uterus")}},
      {"vein", {tissue, sct("29092000", "Vein")}},
      {"vertebra", {structure, sct("51282000", "Vertebra")}},
      {"vessel", {tissue, sct("59820001", "Blood vessel")}},
      {"white-matter", {tissue, sct("389080008", "White Matter")}},
  };
}

using Words = std::vector<std::string>;

// Letters in lower case; everything else separates.
Words words_of(std::string_view text) {
  Words words(1);
  for (const char c : text) {
    if (c >= 'A' && c <= 'Z') {
      words.back() += static_cast<char>(c - 'A' + 'a');
    } else if (c >= 'a' && c <= 'z') {
      words.back() += c;
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

// One or several of it: kidney and kidneys, vertebra and vertebrae.
bool is_word(const std::string& said, const std::string& word) {
  return said == word || said == word + "s" || said == word + "e" || said == word + "es";
}

bool says(const Words& name, const Words& phrase) {
  return !phrase.empty() &&
         std::search(name.begin(), name.end(), phrase.begin(), phrase.end(), is_word) != name.end();
}

// How much a meaning is worth where a name has several: longer phrases say more, and a tumour in the liver is
// a tumour.
std::size_t worth(const SegmentMeaning& meaning, const Words& phrase) {
  constexpr const char* kAbnormal = "49755003";
  return 2 * phrase.size() + (meaning.category.value == kAbnormal ? 1 : 0);
}

}  // namespace

SegmentMeaning guess_segment_meaning(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kOtherWords{
      {{"tumor", "tumour"}, {"csf", "cerebrospinal-fluid"}}};
  const Words said = words_of(name);
  SegmentMeaning best;
  std::size_t most = 0;
  const auto weigh = [&](std::string_view text, const SegmentMeaning& meaning) {
    const Words phrase = words_of(text);
    if (!says(said, phrase) || worth(meaning, phrase) <= most) return;
    most = worth(meaning, phrase);
    best = meaning;
  };
  for (const NamedMeaning& named : segment_meanings()) {
    weigh(named.word, named.meaning);
    weigh(named.meaning.type.meaning, named.meaning);
    for (const auto& [other, word] : kOtherWords) {
      if (word == named.word) weigh(other, named.meaning);
    }
  }
  return best;
}

std::span<const NamedMeaning> segment_meanings() {
  static const std::vector<NamedMeaning> meanings = make_meanings();
  return meanings;
}

Result<SegmentMeaning> find_segment_meaning(std::string_view word) {
  const auto meanings = segment_meanings();
  const auto found = std::find_if(meanings.begin(), meanings.end(),
                                  [&](const NamedMeaning& named) { return named.word == word; });
  if (found != meanings.end()) return found->meaning;
  std::string words;
  for (const NamedMeaning& named : meanings) words.append(words.empty() ? "" : " ").append(named.word);
  return fail(ErrorKind::usage, "'{}' is none of the meanings {}", word, words);
}

}  // namespace tidemark::imaging
