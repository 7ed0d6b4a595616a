# A filter of Doxygen, which keeps the numbers of lines. What every policy of a role has by its concept gets one sentence here instead of one in each policy.
# A comment in the header goes before it. Deduction guides and deleted copies, which say nothing to a reader, are left out.
# A comment before `double a, b;` is that of both.

function role_member(line)
{
    # fields
    if (line ~ /^static constexpr std::string_view name/) return "Its name, in tables, reports and messages; letters are those of `explain`."
    if (line ~ /^static constexpr std::string_view unit/) return "Its unit, kg/m^Dim where it depends on the dimension."
    if (line ~ /^static constexpr std::string_view text/) return "Its formulas, for `explain`."
    if (line ~ /^template <class S> using value =/) return "One value in lanes of the space S."
    if (line ~ /^template <class S> static constexpr int components =/) return "How many numbers a value has."
    if (line ~ /^inline constexpr field::/) {
        sub(/^inline constexpr /, "", line)
        sub(/ .*$/, "", line)
        return "Short for tamis::" line "."
    }
    # every policy
    if (line ~ /^using on_particles =/) return "Fields of particles that it uses; `const` ones it only reads."
    if (line ~ /^using on_nodes =/) return "Fields of nodes that it uses; `const` ones it only reads."
    if (line ~ /^static constexpr bool never = true/) return "It does nothing; a step has no code for it."
    if (line ~ /^void check\(\) const/) return "Throws `error` if a parameter makes no sense."
    # laws
    if (line ~ /^void check\(auto p\) const/) return "Throws `error` if the particle makes no sense."
    if (line ~ /^void start\(auto p\) const/) return "Sets the first values of the law's own fields."
    if (line ~ /^double wave_speed\(/) return "Speed of the fastest waves (m/s)."
    if (line ~ /^double wave_speed_at\(/) return "Speed of the fastest waves in a particle (m/s)."
    if (line ~ /^double largest_step\(/) return "Largest time step that it allows (s)."
    if (line ~ /^static constexpr bool three_by_three =/) return "Is `stress` called with 3 x 3 tensors in every dimension?"
    if (line ~ /^template <class Tensor> Tensor stress\(/) return "New Kirchhoff stress (Pa) of a particle that is strained at the rate L (1/s) for dt (s)."
    if (line ~ /^template <class Tensor> Tensor at_strain\(/) return "Kirchhoff stress (Pa) of a particle with the given strain."
    if (line ~ /^template <class Tensor> Tensor strain_at\(/) return "Strain of a particle with the Kirchhoff stress tau (Pa)."
    if (line ~ /^template <class Tensor> (auto|double) energy\(/) return "Stored energy of a particle (J/m^Dim of reference volume)."
    # conservation laws
    if (line ~ /^static constexpr int unknowns =/) return "How many numbers u has."
    if (line ~ /^template <class State> State flux\(/) return "F(u) along an axis."
    # shapes
    if (line ~ /^static constexpr int support =/) return "How many nodes reach a particle along an axis."
    if (line ~ /^static constexpr double shift =/) return "0: cells of the bookkeeping start at nodes; 0.5: they are centred on nodes."
    if (line ~ /^static constexpr bool constant_slope =/) return "Slopes do not depend on the place."
    if (line ~ /^static constexpr int pivot =/) return "A node whose weight is never small, of which sums are taken last."
    if (line ~ /^template <class T> (TAMIS_INLINE )?axis_weights<T, .> on_axis\(/) return "Weights and slopes (per cell side) at the place r, 0 to 1, of a cell, lowest node first."
    # transfers
    if (line ~ /^using mass_type =/) return "Momentum to velocity."
    if (line ~ /^using update_type =/) return "Velocity to particles."
    if (line ~ /^using carries_type =/) return "What particles give to the nodes."
    if (line ~ /^using to_move =/) return "Fields of nodes that `displacement` reads besides."
    if (line ~ /^static constexpr bool full =/) return "Does it make a velocity of its own of the lumped one?"
    if (line ~ /^static constexpr bool filters_start =/) return "Are the terms those of the momentum of the step's start (XPIC)? Are there any?"
    if (line ~ /^template <class From, class To> void filter\(/) return "Makes the full velocity in To of the lumped one in From."
    if (line ~ /^template <class To> void series\(/) return "Adds to To the increment at hand and the terms that follow it."
    if (line ~ /^template <class Look> void each_term\(/) return "Shows each term of the series."
    if (line ~ /^(static constexpr )?double start_share\(\)/) return "Part of what conditions do to the momentum of the step's start that reaches the particles, 0 to 1."
    if (line ~ /^(auto|const auto&) velocity\(auto/) return "New velocity of a particle (m/s)."
    if (line ~ /^auto displacement\(/) return "How far a particle moves in the step (m)."
    if (line ~ /^static constexpr bool carries_slope =/) return "Particles carry the slope of their velocity."
    if (line ~ /^using (gradients|slopes_by_moment) =/) return "Fields of nodes whose slopes it reads."
    if (line ~ /^auto affine_velocity\(/) return "New slope of the velocity around the particle (1/s)."
    # stress orders
    if (line ~ /^static constexpr double before =/) return "Parts of the step by which particles are strained before the forces, and after the update."
    if (line ~ /^static constexpr bool remap =/) return "Is the later part by the new V, extrapolated once more? Is it explicit Euler's?"
    # conditions
    if (line ~ /^Region region;/) return "Where it acts: a predicate of the place (m)."
    if (line ~ /^bool holds\(/) return "Does it apply to the node at this place (m)?"
    if (line ~ /^auto velocity\(const auto& at/) return "Velocity (m/s) at a place (m) and time (s)."
    if (line ~ /^auto normal\(/) return "The only direction that is held, a unit vector."
    # contact
    if (line ~ /^static constexpr bool always = true/) return "Bodies stick in every direction, in tension too."
    if (line ~ /^template <class real> real tangential\(/) return "Tangential impulse (N s), 0 to `stick`, of bodies pressed together by the impulse `normal`."
    if (line ~ /^static constexpr bool on_momentum =/) return "Is the momentum p+ corrected? Is the velocity at the end of the series?"
    if (line ~ /^static constexpr auto terms =/) return "What is done to the terms of the series."
    # loads
    if (line ~ /^static constexpr bool in_lanes =/) return "`acceleration` is called once for all lanes."
    if (line ~ /^(template <class V> V|auto) acceleration\(/) return "Acceleration (m/s^2) at a place (m), of a velocity (m/s), at a time (s)."
    if (line ~ /^bool chooses\(/) return "Does it act on the particle at this place (m)? Asked once."
    if (line ~ /^auto force\(/) return "Force (N) on a particle at a place (m) and time (s)."
    if (line ~ /^bool takes\(/) return "Does it act on the face with this centre (m) and outward normal? Asked once."
    if (line ~ /^auto per_area\(/) return "Traction (Pa) at a face's centre (m), with its normal, at a time (s)."
    if (line ~ /^double damping\(/) return "Rate of damping (1/s) at a time (s)."
    if (line ~ /^void sees\(/) return "Told the nodes' kinetic energy (J) and mass (kg) at a step's start, and its length (s)."
    if (line ~ /^void restart\(\)/) return "A run begins."
    # motion, leaving, execution, lanes, observers
    if (line ~ /^static constexpr bool moves =/) return "Do particles move?"
    if (line ~ /^static constexpr (choice|auto) when_leaving =/) return "What happens to a particle that leaves the grid."
    if (line ~ /^template <class F> void for_each\(/) return "Calls f(0), ..., f(n - 1), each once, and returns when all are done."
    if (line ~ /count\(\) const|^static constexpr int count\(\)/) return "How many threads there are."
    if (line ~ /^template <class Real> using type =/) return "The scalar of kernels."
    if (line ~ /^void operator\(\)\(const progress_state&/) return "Called by `integrate`, at the start and after every step."
    return ""
}

# "double a, b = 1;" as "double a; double b = 1;" in a group.
function one_by_one(line,    i, c, depth, quoted, from, part, parts, type, all)
{
    if (line !~ /^(static constexpr )?(double|int|long|bool|Real|T|std::string|std::string_view|matrix<[^(]*>) [^(]*,[^(]*;( *\/\/.*)?$/)
        return line
    sub(/;.*$/, "", line)
    parts = 0
    from = 1
    for (i = 1; i <= length(line) + 1; ++i) {
        c = substr(line, i, 1)
        if (c == "\"") quoted = !quoted
        if (c == "<" || c == "{") ++depth
        if (c == ">" || c == "}") --depth
        if (i > length(line) || (c == "," && !depth && !quoted)) {
            part[++parts] = substr(line, from, i - from)
            from = i + 1
        }
    }
    if (parts < 2) return line ";"
    type = part[1]
    sub(/ = .*$/, "", type)
    sub(/ [A-Za-z_0-9]+(\[.*\])?$/, "", type)
    all = part[1] ";"
    for (i = 2; i <= parts; ++i) all = all " " type part[i] ";"
    return in_group ? all : "/** @{ */ " all " /** @} */"
}

{
    line = $0
    sub(/^ +/, "", line)
    indent = substr($0, 1, length($0) - length(line))
}
line ~ /^\/\/\/ @[{]/ { in_group = 1 }
line ~ /^\/\/\/ @[}]/ { in_group = 0 }
# What Eigen asks for is no interface of ours.
line ~ /^namespace Eigen|^template <.*> struct Eigen::/ { of_eigen = 1 }
of_eigen { if ($0 ~ /^}/) of_eigen = 0; print ""; next }
line ~ /= delete;/ { print ""; next }
# Deduction guides, template <...> name(...) -> name<...>; and specialisations of variables, over one line or more: they
# are no names of their own.
skipping { if (line ~ /;$/) skipping = 0; print ""; next }
held != "" {
    if (line ~ /^->/ || line ~ /^inline constexpr bool [a-z_]+</) {
        gsub(/[^\n]+/, "", held)
        print held
        print ""
        held = ""
        skipping = line !~ /;$/
        next
    }
    if (held_is_head && line ~ /^[a-z_]+\(.*\)$/) {
        held = held "\n" $0
        held_is_head = 0
        next
    }
    print held
    held = ""
}
line ~ /^template <.*> [a-z_]+\(.*\) -> / || line ~ /^template <.*> inline constexpr bool [a-z_]+</ {
    skipping = line !~ /;$/
    print ""
    next
}
line ~ /^template <[^()]*>$/ || line ~ /^template <.*> [a-z_]+\(.*\)$/ {
    held = $0
    held_is_head = line ~ /^template <[^()]*>$/
    next
}
# Doxygen 1.9 lets concepts pass, and structs without members.
line ~ /^concept / && !documented {
    split(line, word, " ")
    line = "struct concept_" word[2] "_without_comment { int it; }; template <class> " line
}
line ~ /(struct|class) [a-z_]+.*[{][}];$/ && !documented { sub(/[{][}];$/, "{ int it; };", line) }
{
    sentence = documented ? "" : role_member(line)
    print indent (sentence == "" ? "" : "/** " sentence " */ ") one_by_one(line)
    documented = line ~ /^\/\/\// && line !~ /@}/
}
