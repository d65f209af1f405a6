// The names of the figures that a lesson can measure, known where files are read and nothing is measured.
#pragma once

#include <array>
#include <string_view>

namespace tidemark::document {

// In the order of lesson_figures().
inline constexpr std::array<std::string_view, 15> kFigureNames{"volume_ml",
                                                               "area_cm2",
                                                               "radius_mm",
                                                               "sphericity",
                                                               "bodies",
                                                               "steps",
                                                               "rests",
                                                               "time_step",
                                                               "dice",
                                                               "mean_distance_mm",
                                                               "largest_distance_mm",
                                                               "gradient_error",
                                                               "resident_pages",
                                                               "resident_percent",
                                                               "memory_mib"};

}  // namespace tidemark::document
