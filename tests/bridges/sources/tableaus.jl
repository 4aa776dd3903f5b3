"""
    constructRalston()
"""
function constructRalston(T::Type = Float64)
    A = [0 0; 2//3 0]
    c = [0; 2 // 3]
    α = [1 // 4; 3 // 4]
    αEEst = [1; 0]
    A = map(T, A)
    return DiffEqBase.ExplicitRKTableau(A, c, α, 2, αEEst = map(T, αEEst), adaptiveorder = 1, fsal = false)
end
function constructBig(T::Type = BigFloat)
    A = zeros(T, 2, 2)
    c = zeros(T, 2)
    α = zeros(T, 2)
    c[2] = big"2.0" / 3
    A[2, 1] = convert(T, 2 // 3)
    α[1] = parse(BigFloat, "0.25")
    α[2] = BigInt(3) // BigInt(4)
    return ExplicitRKTableau(A, c, α, 2)
end
imex = AdditiveRungeKuttaMethod([[0//1 0//1; 1//2 0//1], [0//1 0//1; 0//1 1//2]],
    [[0//1, 1//1], [0//1, 1//1]], [[0//1, 1//2], [0//1, 1//2]])
