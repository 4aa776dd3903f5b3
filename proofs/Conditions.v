(** * B(n), C(k), D(k) and the even condition

    For a method with nodes c, with b_l(v) written out in the coefficients of 1, θ, θ², …. *)

From Coq Require Import QArith List Arith Lia.
From Gark Require Import Stages Trees Methods Sums Check Pairs Products.
Import ListNotations.
Open Scope Q_scope.

(** The coefficient of θ^e in the rational number q. *)
Definition rational (q : Q) (e : nat) : Q := if Nat.eqb e 0 then q else 0.
Definition number_of (n : nat) : Q := inject_Z (Z.of_nat n).
(** 1/n. *)
Definition inverse (n : nat) : Q := 1 # Pos.of_nat n.

Section Conditions.
Variable M : method.
Variable c : nat -> V.                 (* the nodes of each colour *)

Notation "x ⊙_ l y" := (mul (Pof M l) x y) (at level 40, l at level 0, left associativity).

(** c^j, for colour l. *)
Fixpoint power_of l (j : nat) : V :=
  match j with O => oneof M l | S j => mul (Pof M l) (c l) (power_of l j) end.

(** b_l(v) = q. *)
Definition quadrature l (v : V) (q : Q) :=
  forall e, (e < degree M)%nat -> b M l e v == rational q e.
(** v = w, at each stage of colour l. *)
Definition same l (v w : V) := forall i, (i < dim M l)%nat -> v i == w i.

(** b_l(c^{j−1}) = 1/j for 1 ≤ j ≤ n. *)
Definition B l n := forall j, (1 <= j <= n)%nat ->
  quadrature l (power_of l (j - 1)) (inverse j).

(** A^{l,m} c^{j−1} = c^j / j for 1 ≤ j ≤ k. *)
Definition C l m k := forall j, (1 <= j <= k)%nat ->
  same l (app (Aof M l m) (power_of m (j - 1))) (scale (inverse j) (power_of l j)).

(** b_l(c^{j−1} A^{l,m} g) = (b_m(g) − b_m(c^j g)) / j for all g, 1 ≤ j ≤ k. *)
Definition D l m k := forall j g e, (1 <= j <= k)%nat -> (e < degree M)%nat ->
  b M l e (power_of l (j - 1) ⊙_l (app (Aof M l m) g))
  == inverse j * (b M m e g - b M m e (power_of m j ⊙_m g)).

(** b_l(c^k A^{l,m} c^k) = 1/(2(k+1)²). *)
Definition even l m k :=
  quadrature l (power_of l k ⊙_l (app (Aof M l m) (power_of m k))) (inverse (2 * S k * S k)).

Definition every_colour (P : nat -> Prop) := forall l, (l < N M)%nat -> P l.
Definition every_block (P : nat -> nat -> Prop) :=
  forall l m, (l < N M)%nat -> (m < N M)%nat -> sees M l m -> P l m.

(** What Theorem B asks of a method, for the order 2k + 1 or 2k + 2. *)
Definition criterion k n :=
  every_colour (fun l => B l n) /\
  every_block (fun l m => C l m k /\ D l m k) /\
  (n = 2 * k + 2 -> every_block (fun l m => even l m k))%nat.

(** The nodes of a colour are the row sums of one of its blocks. *)
Definition nodes_are_row_sums := every_colour (fun l =>
  exists m, (m < N M)%nat /\ sees M l m /\ same l (c l) (app (Aof M l m) (oneof M m))).

(** Weights are definite: b_l(v²) = 0 for v = 0 alone. Positive weights are; see Weights.v. *)
Definition definite := every_colour (fun l => forall v,
  quadrature l (v ⊙_l v) 0 -> same l v (fun _ => 0)).
(** b_l(g v) = 0 for all g for v = 0 alone: weights that are not zero. *)
Definition nondegenerate := every_colour (fun l => forall v,
  (forall g, quadrature l (g ⊙_l v) 0) -> same l v (fun _ => 0)).

(** ** First consequences *)

Lemma definite_is_nondegenerate : definite -> nondegenerate.
Proof. intros H l Hl v K. apply H; [exact Hl|apply K]. Qed.

Lemma veq_sym (v w : V) : veq v w -> veq w v.
Proof. intros H i. symmetry. apply H. Qed.

Lemma same_beyond l v w : same l v w -> (forall i, (dim M l <= i)%nat -> v i == 0) ->
  (forall i, (dim M l <= i)%nat -> w i == 0) -> veq v w.
Proof.
  intros H Hv Hw i. destruct (lt_dec i (dim M l)) as [L|L]; [apply H, L|].
  rewrite Hv, Hw by lia. reflexivity.
Qed.

Lemma power_beyond l j i : (dim M l <= i)%nat -> power_of l j i == 0.
Proof. destruct j; [apply one_beyond|apply mu_beyond]. Qed.

Lemma one_left l v : (forall i, (dim M l <= i)%nat -> v i == 0) -> veq (oneof M l ⊙_l v) v.
Proof.
  intros H. apply veq_trans with (1 := mu_comm M l _ _). apply (same_beyond l).
  - intros i Hi. apply mu_one, Hi.
  - apply mu_beyond.
  - exact H.
Qed.

Lemma power_plus_power l i j : veq (power_of l i ⊙_l power_of l j) (power_of l (i + j)).
Proof.
  induction i; cbn [power_of Nat.add].
  - apply one_left. apply power_beyond.
  - apply veq_trans with (1 := mu_assoc M l _ _ _). apply mu_ext; [apply veq_refl|exact IHi].
Qed.

Lemma psi_beyond t i : (dim M (root t) <= i)%nat -> psi (Pof M) (Aof M) (oneof M) t i == 0.
Proof. destruct t as [l [|u r]]; [apply one_beyond|apply mu_beyond]. Qed.

Lemma b_ext l e v w : veq v w -> b M l e v == b M l e w.
Proof. apply (l_ext _ (b_linear M l e)). Qed.
Lemma b_scale l e q v : b M l e (scale q v) == q * b M l e v.
Proof. apply (l_scale _ (b_linear M l e)). Qed.
Lemma mu_scale l q v w : veq (v ⊙_l scale q w) (scale q (v ⊙_l w)).
Proof. intros i. apply (l_scale _ (mu_right M l v i)). Qed.

(** Stage values are equal if b_l does not tell their products apart. *)
Lemma equal_by_products l v w : nondegenerate -> (l < N M)%nat ->
  (forall g e, (e < degree M)%nat -> b M l e (g ⊙_l v) == b M l e (g ⊙_l w)) -> same l v w.
Proof.
  intros Non Hl H i Hi. assert (Z : same l (add v (scale (-(1)) w)) (fun _ => 0)).
  { apply (Non l Hl). intros g e He.
    rewrite (l_add _ (mul_right _ (Pof M l) g (b_linear M l e))).
    rewrite (l_scale _ (mul_right _ (Pof M l) g (b_linear M l e))), (H g e He).
    unfold rational. destruct (Nat.eqb e 0); ring. }
  specialize (Z i Hi). unfold add, scale in Z. rewrite <- (Qplus_0_l (w i)), <- Z. ring.
Qed.

Lemma number_of_inverse n : (1 <= n)%nat -> inverse n == / number_of n.
Proof.
  intros H. unfold inverse. destruct n; [lia|]. rewrite <- Pos.of_nat_succ. reflexivity.
Qed.
Lemma number_of_plus a c' : number_of (a + c') == number_of a + number_of c'.
Proof. unfold number_of. rewrite Nat2Z.inj_add, inject_Z_plus. reflexivity. Qed.
Lemma number_of_times a c' : number_of (a * c') == number_of a * number_of c'.
Proof. unfold number_of. rewrite Nat2Z.inj_mul, inject_Z_mult. reflexivity. Qed.
Lemma number_of_not_0 n : (1 <= n)%nat -> ~ number_of n == 0.
Proof. unfold number_of, Qeq. simpl. lia. Qed.
End Conditions.
