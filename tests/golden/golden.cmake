# The seed tracer: a second opinion on the picture, and the program behind the reference pictures.
set(seed_tracer golden/seed_tracer.cpp golden/seed_scene.cpp golden/seed_intersect.cpp golden/seed_light.cpp)
lanecast_test(test_seed_tracer LABELS golden SOURCES golden/seed_tracer_test.cpp ${seed_tracer})
lanecast_test(test_reference_pictures LABELS golden SOURCES golden/reference_pictures_test.cpp ${seed_tracer})
