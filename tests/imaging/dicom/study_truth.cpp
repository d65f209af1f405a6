#include "tests/imaging/dicom/study_truth.h"

#include <fmt/format.h>

#include <QCryptographicHash>
#include <QtEndian>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

namespace tidemark::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Lines = std::vector<std::string>;

bool near(double a, double b) {
  return std::abs(a - b) <= 1e-5 * std::max(1.0, std::abs(b));
}

glm::dvec3 vector_of(const Json& numbers, std::size_t first = 0) {
  return {numbers.at(first).get<double>(), numbers.at(first + 1).get<double>(),
          numbers.at(first + 2).get<double>()};
}

// Of the stored values as 32-bit integers; empty where only rescaled ones are kept.
std::string checksum(const Volume& volume) {
  QCryptographicHash hash(QCryptographicHash::Md5);
  const bool stored = std::visit(
      [&](const auto& voxels) {
        if constexpr (std::is_same_v<std::decay_t<decltype(voxels[0])>, float>) return false;
        for (const auto value : voxels) {
          const qint32 little = qToLittleEndian(static_cast<qint32>(value));
          hash.addData(QByteArrayView(reinterpret_cast<const char*>(&little), sizeof little));
        }
        return true;
      },
      volume.voxels);
  return stored ? hash.result().toHex().toStdString() : std::string();
}

class Entry {
 public:
  Entry(const Json& truth, Lines& lines) : truth_(truth), lines_(lines) {}

  void expect(bool same, const std::string& what) {
    if (!same) lines_.push_back(what);
  }

  void compare_files(const imaging::Series& series) {
    expect(series.files.size() == truth_.at("files"), fmt::format("{} files", series.files.size()));
    if (!truth_.contains("order") || series.files.size() != truth_.at("files")) return;
    const Json& order = truth_.at("order");
    expect(series.files.front().filename() == order.front().get<std::string>() &&
               series.files.back().filename() == order.back().get<std::string>(),
           "other order");
  }

  void compare_grid(const Geometry& g) {
    const Json& size = truth_.at("rows_cols").at(0);
    expect(g.size.x == size.at(1) && g.size.y == size.at(0), "other size of the slices");
    if (const Json& spacing = truth_.at("PixelSpacing"); !spacing.empty()) {
      expect(near(g.spacing_mm.x, spacing.at(0).at(1)) && near(g.spacing_mm.y, spacing.at(0).at(0)),
             "other pixel spacing");
    }
    if (truth_.contains("spacing_along_normal")) {
      const double median = truth_.at("spacing_along_normal").at("median");
      expect(std::abs(g.spacing_mm.z - median) < 2e-3 * median, "other slice distance");
    }
    if (truth_.contains("ImageOrientationPatient")) {
      const Json& o = truth_.at("ImageOrientationPatient");
      expect(glm::length(g.direction[0] - vector_of(o)) < 1e-5 &&
                 glm::length(g.direction[1] - vector_of(o, 3)) < 1e-5,
             "other orientation");
    }
    if (!truth_.contains("first_IPP")) return;
    const glm::dvec3 last = g.to_patient({0.0, 0.0, static_cast<double>(g.size.z - 1)});
    expect(glm::length(g.origin_mm - vector_of(truth_.at("first_IPP"))) < 1e-3 &&
               glm::length(last - vector_of(truth_.at("last_IPP"))) < 0.02,
           "other positions");
  }

  // Of all volumes that were made of the entry together.
  void compare_values(const std::vector<const Loaded*>& parts) {
    const Json& rescaled = truth_.at("rescaled");
    double sum = 0.0;
    std::size_t count = 0;
    float low = std::numeric_limits<float>::max();
    float high = std::numeric_limits<float>::lowest();
    for (const Loaded* part : parts) {
      const auto [least, most] = part->volume.range();
      low = std::min(low, least);
      high = std::max(high, most);
      const std::vector<float> values = part->volume.values();
      for (const float value : values) sum += static_cast<double>(value);
      count += values.size();
    }
    expect(near(static_cast<double>(low), rescaled.at("min")) &&
               near(static_cast<double>(high), rescaled.at("max")),
           "other range of values");
    expect(count == rescaled.at("n"), fmt::format("{} voxels", count));
    if (count == rescaled.at("n")) {
      expect(near(sum / static_cast<double>(count), rescaled.at("mean")), "other mean");
    }
    if (parts.size() != 1 || count != rescaled.at("n")) return;
    const std::string sum_of_pixels = checksum(parts.front()->volume);
    expect(sum_of_pixels.empty() || sum_of_pixels == truth_.at("pixels_md5_int32le"), "other pixels");
  }

 private:
  const Json& truth_;
  Lines& lines_;
};

bool lies_under(const fs::path& file, const fs::path& place) {
  return std::mismatch(place.begin(), place.end(), file.begin(), file.end()).first == place.end();
}

// The key is "FOLDER OR FILE | END OF THE UID".
void compare_series(const std::string& key, const Json& truth, const fs::path& folder,
                    const std::vector<Loaded>& loaded, Lines& lines) {
  if (!truth.contains("rescaled")) return;  // holds no image
  const fs::path place = folder / key.substr(0, key.find(" | "));
  std::vector<const Loaded*> parts;
  for (const Loaded& one : loaded) {
    const auto& files = one.series->files;
    if (std::any_of(files.begin(), files.end(), [&](const auto& file) { return lies_under(file, place); })) {
      parts.push_back(&one);
    }
  }
  if (parts.empty()) return;  // refused, with a reason
  Entry entry(truth, lines);
  if (parts.size() > 1) {
    lines.push_back(fmt::format("{} volumes", parts.size()));
  } else {
    entry.compare_files(*parts.front()->series);
    entry.compare_grid(parts.front()->volume.geometry);
  }
  entry.compare_values(parts);
}

void compare_volume_file(const Json& truth, const Volume& volume, Lines& lines) {
  const Geometry& g = volume.geometry;
  const auto expect = [&](bool same, const char* what) {
    if (!same) lines.emplace_back(what);
  };
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<std::size_t>(axis);
    expect(g.size[axis] == truth.at("shape").at(at), "other size");
    expect(std::abs(g.spacing_mm[axis] - truth.at("zooms").at(at).get<double>()) < 1e-4, "other spacing");
  }
  std::string letters = axis_letters(g);
  std::replace(letters.begin(), letters.end(), 'H', 'S');
  std::replace(letters.begin(), letters.end(), 'F', 'I');
  expect(letters == truth.at("axes"), "other axes");
  const auto [low, high] = volume.range();
  expect(near(static_cast<double>(low), truth.at("min")) && near(static_cast<double>(high), truth.at("max")),
         "other range of values");
  if (!truth.contains("label_voxels") || !truth.at("label_voxels").is_object()) return;
  const std::vector<float> values = volume.values();
  for (const auto& [label, count] : truth.at("label_voxels").items()) {
    expect(std::count(values.begin(), values.end(), std::stof(label)) == count, "other voxels of labels");
  }
}

}  // namespace

std::vector<std::string> differences(const Json& study, const fs::path& folder,
                                     const std::vector<Loaded>& loaded) {
  Lines lines;
  for (const auto& [key, truth] : study.at("series").items()) {
    compare_series(key, truth, folder, loaded, lines);
  }
  for (const auto& [file, truth] : study.at("volumes").items()) {
    const auto found = std::find_if(loaded.begin(), loaded.end(), [&, name = file](const Loaded& one) {
      return one.series->files.front() == folder / name;
    });
    if (found == loaded.end()) {
      lines.push_back(file + " is not loaded");
    } else {
      compare_volume_file(truth, found->volume, lines);
    }
  }
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

std::string axis_letters(const Geometry& grid) {
  constexpr const char* kTowards[3][2] = {{"R", "L"}, {"A", "P"}, {"F", "H"}};
  std::string letters;
  for (int axis = 0; axis < 3; ++axis) {
    int strongest = 0;
    for (int part = 1; part < 3; ++part) {
      if (std::abs(grid.direction[axis][part]) > std::abs(grid.direction[axis][strongest])) strongest = part;
    }
    letters += kTowards[strongest][grid.direction[axis][strongest] > 0 ? 1 : 0];
  }
  return letters;
}

}  // namespace tidemark::test
