#pragma once
#include "measurement.hpp"

#include <optional>
#include <vector>

/// Indices of the runs that no other beats in both error and run time, by falling error. Of equal ones the first is
/// taken. Runs without an answer, and errors of `worst` and more, are left out.
std::vector<std::size_t> pareto_front(const std::vector<measurement>& runs, double worst = 1);

/// The order p of error ~ h^p over the resolutions of one family: the slope of a line through (log cells, log error) by
/// least squares, over the runs that have an answer below `worst`. Nothing for fewer than two of them.
std::optional<double> observed_order(const std::vector<measurement>& family, double worst = 1);

/// The fastest run whose error is at most `target`; nothing if there is none.
std::optional<std::size_t> fastest_within(const std::vector<measurement>& runs, double target);

/// Runs of the same composition and different numbers of cells, in the order in which they come first.
std::vector<std::vector<measurement>> families(const std::vector<measurement>& runs);

/// The median; of an even number the mean of the middle two. `values` is not empty.
double median(std::vector<double> values);
