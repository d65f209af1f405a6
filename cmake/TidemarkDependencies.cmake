# Every third-party package, found once. What each is for: docs/5-dependencies.md.
find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(tl-expected REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(hwy REQUIRED)
find_package(DCMTK REQUIRED)
find_package(OpenJPEG REQUIRED)
find_package(Qt6 6.4 REQUIRED COMPONENTS Core Gui Widgets OpenGL OpenGLWidgets Svg Test)
# Without the names of each test's folders, which would keep tests from sharing precompiled headers.
set_property(TARGET Qt6::Test PROPERTY INTERFACE_COMPILE_DEFINITIONS QT_TESTLIB_LIB)

# ITK without its Use file: include directories and libraries go to the targets that need them, no others.
# Its configuration finds every library that any of its modules may use and says much about each.
set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
find_package(ITK 5.2 REQUIRED COMPONENTS ITKCommon ITKIOImageBase ITKIONIFTI ITKIONRRD ITKIOMeta ITKIOGIPL
             ITKSmoothing ITKRegionGrowing ITKLevelSets ITKMetricsv4 ITKOptimizersv4 ITKTransform)
unset(CMAKE_MESSAGE_LOG_LEVEL)
message(STATUS "Found ITK: ${ITK_DIR} (found version \"${ITK_VERSION}\")")
# What reading, writing and smoothing volumes needs. (ITK_LIBRARIES holds the level sets' libraries too.)
add_library(tidemark_itk INTERFACE)
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  target_compile_options(tidemark_itk INTERFACE -include ${CMAKE_SOURCE_DIR}/cmake/itk_with_clang.h)
endif()
target_include_directories(tidemark_itk SYSTEM INTERFACE ${ITK_INCLUDE_DIRS})
target_link_libraries(tidemark_itk INTERFACE
  ITKCommon ITKIOImageBase ITKIONIFTI ITKIONRRD ITKIOMeta ITKIOGIPL ITKSmoothing)
find_package(ZLIB REQUIRED)
find_package(CURL 7.87 REQUIRED)
find_package(GIF REQUIRED)
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)
find_package(TIFF 4.5 REQUIRED)

find_package(TidemarkOpenVDB REQUIRED)

find_package(PkgConfig REQUIRED)
pkg_check_modules(epoxy REQUIRED IMPORTED_TARGET epoxy)
pkg_check_modules(libzip REQUIRED IMPORTED_TARGET libzip)
find_package(OpenSSL REQUIRED COMPONENTS Crypto SSL)
