(** * Methods as data, and what it means that one has an order

    Numbers of Q(θ) are lists of rationals, the coefficients of 1, θ, θ², …. A stage value over
    Q(θ) is written in the rationals: entry i·d + e is the coefficient of θ^e at stage i. *)

From Coq Require Import QArith List Arith Lia.
From Gark Require Import Stages Trees.
Import ListNotations.
Open Scope Q_scope.

Definition number := list Q.

(** s stages at points; or polynomials modulo one of degree s. Of such a polynomial, which is monic,
    the coefficients below the leading one are given, from the lowest. *)
Inductive space := Points (s : nat) | Modulo (m : list Q).

Record method := {
  field : list Q;                              (* the monic polynomial of θ; [0] for the rationals
    *)
  spaces : list space;
  colours : list (nat * list number);          (* the space of a colour, counted from 0; b *)
  blocks : list (list (option (list (list number)))) }.   (* for a space and a colour: A *)

Section Meaning.
Variable M : method.

Definition degree := length (field M).
Definition size_of s := match s with Points n => n | Modulo m => length m end.
Definition space_of l := fst (nth l (colours M) (O, [])).
Definition the_space k := nth k (spaces M) (Points 0).
Definition block k m := nth m (nth k (blocks M) []) None.

(** x r modulo the polynomial: r is shifted, and its last coefficient times the polynomial taken
  away. *)
Definition times_x (m r : list Q) : list Q :=
  let top := last r 0 in
  map (fun '(a, c) => Qred (a - top * c)) (combine (0 :: removelast r) m).
(** x^n modulo the polynomial. *)
Fixpoint power (m : list Q) (n : nat) : list Q :=
  match n with
  | O => firstn (length m) (1 :: repeat 0 (length m))
  | S n => times_x m (power m n)
  end.

(** The coefficient of basis element i in the product of those numbered a and c. *)
Definition in_space (s : space) (i a c : nat) : Q :=
  match s with
  | Points _ => if andb (Nat.eqb i a) (Nat.eqb i c) then 1 else 0
  | Modulo m => nth i (power m (a + c)) 0
  end.
Definition in_field (e u v : nat) : Q := nth e (power (field M) (u + v)) 0.
(** The coefficient of θ^e in the product of two numbers. *)
Definition times (x y : nat -> Q) (e : nat) : Q :=
  let sum f := fold_right Qplus 0 (map f (seq 0 degree)) in
  sum (fun u => sum (fun v => in_field e u v * x u * y v)).

Definition nonzero {X} (ts : list (X * Q)) := filter (fun t => negb (Qeq_bool (snd t) 0)) ts.
Definition every s := list_prod (seq 0 (size_of s)) (seq 0 degree).
Definition entry (n : nat * nat) := (fst n * degree + snd n)%nat.

(** ⊙ on the stage values of a space: of the stages and of the field at once. *)
Definition product_row (s : space) (n : nat * nat) : list (nat * nat * Q) :=
  nonzero (map (fun '((a, u), (c, v)) =>
      (entry (a, u), entry (c, v), Qred (in_space s (fst n) a c * in_field (snd n) u v)))
    (list_prod (every s) (every s))).
Definition product_of (s : space) : list (list (nat * nat * Q)) := map (product_row s) (every s).

(** The coefficient of θ^e in x θ^u. *)
Definition coefficient (x : number) (e u : nat) : Q :=
  Qred (fold_right Qplus 0 (map (fun w => nth w x 0 * in_field e w u) (seq 0 degree))).

Definition block_row (row : list number) (e : nat) : list (nat * Q) :=
  nonzero (flat_map (fun '(j, x) =>
      map (fun u => (entry (j, u), coefficient x e u)) (seq 0 degree))
    (combine (seq 0 (length row)) row)).
Definition rows_of (A : list (list number)) : list (list (nat * Q)) :=
  flat_map (fun row => map (block_row row) (seq 0 degree)) A.

Definition rows k m : list (list (nat * Q)) :=
  match block k m with None => [] | Some A => rows_of A end.

Definition Aof l m : matrix := fun i => nth i (rows (space_of l) m) [].
Definition Pof l : product := fun i => nth i (product_of (the_space (space_of l))) [].

(** 𝟙: the number 1 at each point, or the polynomial 1. *)
Definition one_of (s : space) : list Q :=
  map (fun '(i, e) => match s with
    | Points _ => if Nat.eqb e 0 then 1 else 0
    | Modulo _ => if Nat.eqb (i + e) 0 then 1 else 0 end) (every s).
Definition oneof l : V := fun i => nth i (one_of (the_space (space_of l))) 0.

Definition sees l m := block (space_of l) m <> None.

(** The coefficient of θ^e in b_l · x. *)
Definition weights l e : list (nat * Q) := block_row (snd (nth l (colours M) (O, []))) e.
Definition b l e (x : V) : Q := lin (weights l e) x.

Definition N := length (colours M).

(** The order condition of u: b · ψ(u) = 1/ρ(u), a rational number; it is 1/γ(u) for the elementary
    weight. *)
Definition holds (t : tree) := forall e, (e < degree)%nat ->
  b (root t) e (psi Pof Aof oneof t) ==
    if Nat.eqb e 0 then 1 # Pos.of_nat (order t) else 0.

Definition is_tree t := admissible sees N t.
End Meaning.

(** Every N-tree up to order p meets its condition. *)
Definition has_order (M : method) (p : nat) :=
  forall t, (order t <= p)%nat -> is_tree M t -> holds M t.
