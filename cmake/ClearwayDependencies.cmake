# Third-party packages, under their Debian 12 names in `./dev setup`.
find_package(absl REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
if(CLEARWAY_BUILD_TESTS)
  find_package(GTest REQUIRED)
endif()
