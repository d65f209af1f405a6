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
find_package(Qt6 6.4 REQUIRED COMPONENTS Core Test)

# ITK without its Use file: include directories and libraries go to the targets that need them, no others.
find_package(ITK REQUIRED COMPONENTS ITKCommon ITKIOImageBase ITKIONIFTI ITKIONRRD ITKIOMeta ITKIOGIPL
             ITKIOGDCM ITKSmoothing ITKLevelSets ITKThresholding ITKRegionGrowing ITKConnectedComponents
             ITKDistanceMap)

# OpenVDB comes with a find module of its own, beside the other packages' configurations.
list(APPEND CMAKE_MODULE_PATH /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)
find_package(OpenVDB REQUIRED COMPONENTS openvdb)
