# OMPL as the target ompl::ompl, which its packages export from 1.6 on. Debian's 1.5.2 sets variables only, among them
# libode and libboost_serialization, of which users of libompl need the headers at most.
find_package(ompl 1.5.2 REQUIRED)
if(NOT TARGET ompl::ompl)
  find_package(Boost REQUIRED)
  find_package(Eigen3 3.4 REQUIRED NO_MODULE)
  set(clearway_ompl_libraries ${OMPL_LIBRARIES})
  list(FILTER clearway_ompl_libraries INCLUDE REGEX "libompl")
  add_library(ompl::ompl INTERFACE IMPORTED)
  # An imported target's include directories are SYSTEM for those who link it.
  target_include_directories(ompl::ompl INTERFACE ${OMPL_INCLUDE_DIR})
  target_link_libraries(ompl::ompl INTERFACE ${clearway_ompl_libraries} Boost::headers Eigen3::Eigen)
endif()
