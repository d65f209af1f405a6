# Writes OUTPUT, a C++ file that holds every preset of FOLDER as text, by its name without ".json".
file(GLOB presets RELATIVE ${FOLDER} ${FOLDER}/*.json)
list(SORT presets)
set(entries "")
foreach(preset ${presets})
  file(READ ${FOLDER}/${preset} text)
  string(REGEX REPLACE "\\.json$" "" name "${preset}")
  string(APPEND entries "      {\"${name}\", R\"json(${text})json\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"renderer/embedded_presets.h\"

namespace tidemark {

std::span<const EmbeddedPreset> embedded_presets() {
  static constexpr EmbeddedPreset kPresets[] = {
${entries}  };
  return kPresets;
}

}  // namespace tidemark
")
