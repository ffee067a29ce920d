// Properties that must hold whatever the input: seeded random cases, the worst of them kept. Run by `patina
// bench stability` and by the tests. A trial is fully given by its seed.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

class Renderer;

/// SplitMix64 (Steele, Lea, Flood 2014): the same numbers on every machine.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next();
    double uniform();                             ///< in [0, 1)
    double between(double low, double high);      ///< uniform
    double log_between(double low, double high);  ///< uniform in the logarithm; low > 0
    int below(int count);                         ///< 0 … count − 1
    bool chance(double probability);
    glm::dvec3 direction();  ///< unit, uniform over the sphere

private:
    std::uint64_t state_;
};

/// Makes what drawing needs when the first property asks for it.
class Stage {
public:
    Stage();
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
    /// Throws std::runtime_error where there is no OpenGL to draw with.
    Renderer& renderer();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Of one trial, which may stand for many cases (the pixels of a picture, the texels of a level).
struct Trial {
    std::int64_t cases = 0;
    double error = 0.0;  ///< the worst of the cases; NaN counts as infinite

    /// One more case.
    void add(double case_error);
    /// One more case that either holds (0) or does not (1).
    void require(bool holds) { add(holds ? 0.0 : 1.0); }
};

struct Property {
    std::string_view id;         ///< "ggx-integral"
    std::string_view statement;  ///< "∫ D cos θ dω = 1"
    double tolerance = 0.0;      ///< largest error that still holds
    std::int64_t cases = 0;      ///< tried every day
    std::function<Trial(Random& random, Stage& stage)> run;
};

/// The reflection model, its tables and tone mappers.
std::vector<Property> reflection_properties();
/// Loading, transforming and baking environments.
std::vector<Property> light_properties();
/// Meshes from disordered triangles to tangents.
std::vector<Property> mesh_properties();
/// The shaders, drawn at full precision and read back.
std::vector<Property> picture_properties();
/// All of them.
std::vector<Property> stability_properties();

struct PropertyReport {
    std::int64_t cases = 0;
    std::int64_t trials = 0;
    std::int64_t failed_trials = 0;
    double worst = 0.0;
    std::uint64_t worst_seed = 0;  ///< trying this seed alone gives the worst value again
    double seconds = 0.0;          ///< of processor time
};
/// Trials with seeds first_seed, first_seed + 1, … until so many cases have been tried.
PropertyReport check_property(const Property& property, std::int64_t cases, std::uint64_t first_seed,
                              Stage& stage);

}  // namespace patina
