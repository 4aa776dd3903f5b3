(** * Stage values of a colour form a commutative algebra

    Products of stage values are associative and commutative, and 𝟙 is neutral: at points, modulo a
    polynomial, over ℚ and over ℚ(θ). *)

From Coq Require Import QArith List Arith Lia.
From Gark Require Import Stages Methods Sums Pairs.
Import ListNotations.
Open Scope Q_scope.

(** ** Structure constants *)

(** t i a c is the coefficient of basis element i in the product of those numbered a and c, below n;
    o i that of 1. *)
Record algebra (n : nat) (t : nat -> nat -> nat -> Q) (o : nat -> Q) : Prop := {
  commutes : forall i a c, t i a c == t i c a;
  associates : forall i a c d, (i < n)%nat -> (a < n)%nat -> (c < n)%nat -> (d < n)%nat ->
    sum (seq 0 n) (fun w => t i w d * t w a c) == sum (seq 0 n) (fun w => t i a w * t w c d);
  is_neutral : forall i a, (i < n)%nat -> (a < n)%nat ->
    sum (seq 0 n) (fun w => t i a w * o w) == if Nat.eqb i a then 1 else 0 }.

(** x^n v, for v the polynomial x^k modulo m. *)
Lemma power_plus m k n i : (i < length m)%nat ->
  sum (seq 0 (length m)) (fun w => nth i (power m (w + n)) 0 * nth w (power m k) 0)
  == nth i (power m (k + n)) 0.
Proof.
  revert i. induction n; intros i H.
  - rewrite (sum_ext _ _ (fun w => (if Nat.eqb w i then 1 else 0) * nth w (power m k) 0)).
    + rewrite sum_at by exact H. rewrite Nat.add_0_r. reflexivity.
    + intros w I. apply in_seq in I. rewrite Nat.add_0_r, power_small by lia.
      rewrite Nat.eqb_sym. reflexivity.
  - rewrite Nat.add_succ_r, power_S by exact H.
    rewrite <- (IHn (length m - 1)%nat) by lia.
    rewrite (sum_ext _ _ (fun w => (if Nat.eqb i 0 then 0 else
        nth (i - 1) (power m (w + n)) 0 * nth w (power m k) 0)
      + (- nth i m 0) * (nth (length m - 1) (power m (w + n)) 0 * nth w (power m k) 0))).
    + rewrite sum_shifted. destruct (Nat.eqb_spec i 0); [ring|]. rewrite IHn by lia. ring.
    + intros w _. rewrite Nat.add_succ_r, power_S by exact H. destruct (Nat.eqb i 0); ring.
Qed.

Lemma modulo_algebra m :
  algebra (length m) (fun i a c => nth i (power m (a + c)) 0)
    (fun i => if Nat.eqb i 0 then 1 else 0).
Proof.
  split.
  - intros i a c. rewrite Nat.add_comm. reflexivity.
  - intros i a c d Hi _ _ _. rewrite power_plus by exact Hi.
    rewrite <- Nat.add_assoc, (Nat.add_comm a), <- power_plus by exact Hi. apply sum_ext.
    intros w _.
    rewrite (Nat.add_comm w). reflexivity.
  - intros i a Hi Ha.
    rewrite (sum_ext _ _ (fun w => (if Nat.eqb w 0 then 1 else 0) * nth i (power m (a + w)) 0))
      by (intros; ring).
    rewrite sum_at by lia. rewrite Nat.add_0_r. apply power_small; assumption.
Qed.

Lemma points_algebra n :
  algebra n (fun i a c => if andb (Nat.eqb i a) (Nat.eqb i c) then 1 else 0) (fun _ => 1).
Proof.
  split.
  - intros i a c. rewrite Bool.andb_comm. reflexivity.
  - intros i a c d Hi _ _ _.
    transitivity (if andb (Nat.eqb i a) (andb (Nat.eqb i c) (Nat.eqb i d)) then 1 else 0).
    + rewrite (sum_ext _ _ (fun w => (if Nat.eqb w i then 1 else 0) *
        (if andb (Nat.eqb i a) (andb (Nat.eqb i c) (Nat.eqb i d)) then 1 else 0))).
      * rewrite sum_at by exact Hi. reflexivity.
      * intros w _. rewrite (Nat.eqb_sym w i). destruct (Nat.eqb_spec i w) as [<-|]; simpl.
        -- destruct (Nat.eqb i a), (Nat.eqb i c), (Nat.eqb i d); reflexivity.
        -- ring.
    + symmetry. rewrite (sum_ext _ _ (fun w => (if Nat.eqb w i then 1 else 0) *
        (if andb (Nat.eqb i a) (andb (Nat.eqb i c) (Nat.eqb i d)) then 1 else 0))).
      * rewrite sum_at by exact Hi. reflexivity.
      * intros w _. rewrite (Nat.eqb_sym w i). destruct (Nat.eqb_spec i w) as [<-|]; simpl.
        -- destruct (Nat.eqb i a), (Nat.eqb i c), (Nat.eqb i d); reflexivity.
        -- rewrite Bool.andb_false_r. ring.
  - intros i a Hi Ha.
    rewrite (sum_ext _ _ (fun w => (if Nat.eqb w i then 1 else 0)
      * (if Nat.eqb i a then 1 else 0))).
    + rewrite sum_at by exact Hi. reflexivity.
    + intros w _. rewrite (Nat.eqb_sym w i). destruct (Nat.eqb i w), (Nat.eqb i a); simpl; ring.
Qed.

Definition in_one s i : Q :=
  match s with Points _ => 1 | Modulo _ => if Nat.eqb i 0 then 1 else 0 end.
Lemma space_algebra s : algebra (size_of s) (in_space s) (in_one s).
Proof. destruct s; [apply points_algebra|apply modulo_algebra]. Qed.

(** ** The products of a method *)

Section Products.
Variable M : method.

Notation mu l := (mul (Pof M l)).
Definition field_algebra : algebra (degree M) (in_field M) (fun e => if Nat.eqb e 0 then 1 else 0)
  := modulo_algebra (field M).

Lemma entry_eq i e j v : (e < degree M)%nat -> (v < degree M)%nat ->
  Nat.eqb (entry M (i, e)) (entry M (j, v)) = andb (Nat.eqb i j) (Nat.eqb e v).
Proof.
  unfold entry. cbn [fst snd]. intros He Hv. apply Bool.eq_true_iff_eq.
  rewrite Bool.andb_true_iff, !Nat.eqb_eq. split; [|intros [-> ->]; reflexivity].
  intros E. assert (i = j) by nia. subst. lia.
Qed.

Lemma mu_ext l x x' y y' : veq x x' -> veq y y' -> veq (mu l x y) (mu l x' y').
Proof. intros Hx Hy. apply (mu_below M); intros; [apply Hx|apply Hy]. Qed.

Lemma mu_comm l x y : veq (mu l x y) (mu l y x).
Proof.
  intros n. destruct (lt_dec n (dim M l)) as [L|L].
  - destruct (entry_of M n _ L) as [i [e [Hi [He ->]]]]. rewrite !mu_at by assumption.
    rewrite (sum_pairs _ _ _), (sum_pairs _ _ _).
    rewrite sum_swap. apply sum_ext. intros a _. apply sum_ext. intros c _. cbn [fst snd].
    rewrite (commutes _ _ _ (space_algebra (space_at M l)) i), (commutes _ _ _ field_algebra e). ring.
  - rewrite !mu_beyond by lia. reflexivity.
Qed.

Lemma mu_left l y : forall n, linear (fun x => mu l x y n).
Proof. intros n. apply bil_left. Qed.
Lemma mu_right l x : forall n, linear (fun y => mu l x y n).
Proof. intros n. apply bil_right. Qed.

(** A product with a basis element. *)
Lemma mu_unit l x c v i e : (c < size_of (space_at M l))%nat -> (v < degree M)%nat ->
  (i < size_of (space_at M l))%nat -> (e < degree M)%nat ->
  mu l x (unit (entry M (c, v))) (entry M (i, e)) ==
  sum (every M (space_at M l)) (fun p =>
    in_space (space_at M l) i (fst p) c * in_field M e (snd p) v * x (entry M p)).
Proof.
  intros Hc Hv Hi He. rewrite mu_at by assumption. rewrite sum_pairs. apply sum_ext. intros [a u] _.
  unfold every. rewrite sum_pairs. cbn [fst snd].
  rewrite (sum_ext _ _ (fun c' => (if Nat.eqb c' c then 1 else 0) *
    (in_space (space_at M l) i a c' * in_field M e u v * x (entry M (a, u))))).
  - rewrite sum_at by assumption. reflexivity.
  - intros c' _. rewrite (sum_ext _ _ (fun v' => (if Nat.eqb v' v then 1 else 0) *
      ((if Nat.eqb c' c then 1 else 0) * (in_space (space_at M l)
        i a c' * in_field M e u v' * x (entry M (a, u)))))).
    + rewrite sum_at by assumption. reflexivity.
    + intros v' Iv. apply in_seq in Iv. rewrite unit_at, entry_eq by lia.
      destruct (Nat.eqb c' c), (Nat.eqb v' v); simpl; ring.
Qed.
Lemma mu_units l a u c v i e : (a < size_of (space_at M l))%nat -> (u < degree M)%nat ->
  (c < size_of (space_at M l))%nat -> (v < degree M)%nat ->
  (i < size_of (space_at M l))%nat -> (e < degree M)%nat ->
  mu l (unit (entry M (a, u))) (unit (entry M (c, v))) (entry M (i, e)) ==
  in_space (space_at M l) i a c * in_field M e u v.
Proof.
  intros Ha Hu Hc Hv Hi He. rewrite mu_unit by assumption. unfold every. rewrite sum_pairs.
  cbn [fst snd].
  rewrite (sum_ext _ _ (fun a' => (if Nat.eqb a' a then 1 else 0) * (in_space (space_at M l)
    i a' c * in_field M e u v))).
  - rewrite sum_at by assumption. reflexivity.
  - intros a' _. rewrite (sum_ext _ _ (fun u' => (if Nat.eqb u' u then 1 else 0) *
      ((if Nat.eqb a' a then 1 else 0) * (in_space (space_at M l) i a' c * in_field M e u' v)))).
    + rewrite sum_at by assumption. reflexivity.
    + intros u' Iu. apply in_seq in Iu. rewrite unit_at, entry_eq by lia.
      destruct (Nat.eqb a' a), (Nat.eqb u' u); simpl; ring.
Qed.

Lemma local_left l y n : local (dim M l) (fun x => mu l x y n).
Proof. intros x x' H. apply (mu_below M); [exact H|reflexivity]. Qed.
Lemma local_right l x n : local (dim M l) (fun y => mu l x y n).
Proof. intros y y' H. apply (mu_below M); [reflexivity|exact H]. Qed.

Lemma equal_on_units n f g : linear f -> linear g -> local n f -> local n g ->
  (forall i, (i < n)%nat -> f (unit i) == g (unit i)) -> forall x, f x == g x.
Proof.
  intros Lf Lg Kf Kg H x.
  assert (E : f x + -(1) * g x == 0).
  { apply (zero_on_units n (fun x => f x + -(1) * g x)).
    - apply linear_plus; [exact Lf|]. apply linear_times, Lg.
    - intros y y' E. rewrite (Kf y y' E), (Kg y y' E). reflexivity.
    - intros i Hi. rewrite (H i Hi). ring. }
  setoid_replace (f x) with (f x + -(1) * g x + g x) by ring. rewrite E. ring.
Qed.

Theorem mu_assoc l x y z : veq (mu l (mu l x y) z) (mu l x (mu l y z)).
Proof.
  intros n. destruct (lt_dec n (dim M l)) as [L|L]; [|rewrite !mu_beyond by lia; reflexivity].
  destruct (entry_of M n _ L) as [i [e [Hi [He ->]]]].
  set (n := entry M (i, e)).
  assert (Ext : forall f, linear f -> forall g, (forall m, linear (fun x => g x m)) ->
    linear (fun x => f (g x))).
  { intros f Lf g Lg. split; intros.
    - apply (l_ext _ Lf). intros m. apply (l_ext _ (Lg m)). assumption.
    - rewrite <- (l_add _ Lf). apply (l_ext _ Lf). intros m. apply (l_add _ (Lg m)).
    - rewrite <- (l_scale _ Lf). apply (l_ext _ Lf). intros m. apply (l_scale _ (Lg m)). }
  apply (equal_on_units (dim M l) (fun x => mu l (mu l x y) z n) (fun x => mu l x (mu l y z) n)).
  { apply (Ext (fun w => mu l w z n)); [apply mu_left|intros; apply mu_left]. }
  { apply mu_left. }
  { intros w w' E. apply mu_ext; [|apply veq_refl]. intros m. apply local_left, E. }
  { apply local_left. }
  clear x. intros x Hx. destruct (entry_of M x _ Hx) as [a [u [Ha [Hu ->]]]]. clear Hx.
  apply (equal_on_units (dim M l) (fun y => mu l (mu l (unit (entry M (a, u))) y) z n)
    (fun y => mu l (unit (entry M (a, u))) (mu l y z) n)).
  { apply (Ext (fun w => mu l w z n)); [apply mu_left|intros; apply mu_right]. }
  { apply (Ext (fun w => mu l _ w n)); [apply mu_right|intros; apply mu_left]. }
  { intros w w' E. apply mu_ext; [|apply veq_refl]. intros m. apply local_right, E. }
  { intros w w' E. apply mu_ext; [apply veq_refl|]. intros m. apply local_left, E. }
  clear y. intros y Hy. destruct (entry_of M y _ Hy) as [c [v [Hc [Hv ->]]]]. clear Hy.
  apply (equal_on_units (dim M l)
    (fun z => mu l (mu l (unit (entry M (a, u))) (unit (entry M (c, v)))) z n)
    (fun z => mu l (unit (entry M (a, u))) (mu l (unit (entry M (c, v))) z) n)).
  { apply mu_right. }
  { apply (Ext (fun w => mu l _ w n)); [apply mu_right|intros; apply mu_right]. }
  { apply local_right. }
  { intros w w' E. apply mu_ext; [apply veq_refl|]. intros m. apply local_right, E. }
  clear z. intros z Hz. destruct (entry_of M z _ Hz) as [d [w [Hd [Hw ->]]]]. clear Hz.
  unfold n. rewrite (mu_unit l _ d w) by assumption.
  rewrite (mu_comm l (unit (entry M (a, u))) _ _), (mu_unit l _ a u) by assumption.
  rewrite (sum_ext _ _ (fun p => (in_space (space_at M l) i (fst p) d * in_space (space_at M l) (fst p)
    a c)
    * (in_field M e (snd p) w * in_field M (snd p) u v))).
  2:{ intros [g h] I. unfold every in I. rewrite in_prod_iff, !in_seq in I.
  rewrite mu_units by lia. cbn [fst snd]. ring. }
  symmetry. rewrite (sum_ext _ _ (fun p => (in_space (space_at M l) i a (fst p)
    * in_space (space_at M l) (fst p) c d)
    * (in_field M e u (snd p) * in_field M (snd p) v w))).
  2:{ intros [g h] I. unfold every in I. rewrite in_prod_iff, !in_seq in I.
  rewrite mu_units by lia. cbn [fst snd].
      rewrite (commutes _ _ _ (space_algebra (space_at M l)) i), (commutes _ _ _ field_algebra e).
      ring. }
  unfold every.
  rewrite (sum_of_products _ _ (fun g => in_space (space_at M l) i a g * in_space (space_at M l) g c d)
    (fun h => in_field M e u h * in_field M h v w)).
  rewrite (sum_of_products _ _ (fun g => in_space (space_at M l) i g d * in_space (space_at M l) g a c)
    (fun h => in_field M e h w * in_field M h u v)).
  rewrite (associates _ _ _ (space_algebra (space_at M l)) i a c d) by assumption.
  rewrite (associates _ _ _ field_algebra e u v w) by assumption. reflexivity.
Qed.

Theorem mu_one l x n : (n < dim M l)%nat -> mu l x (oneof M l) n == x n.
Proof.
  intros L. revert n L x. intros n L. destruct (entry_of M n _ L) as [i [e [Hi [He ->]]]].
  apply (equal_on_units (dim M l) (fun x => mu l x (oneof M l) (entry M (i,
    e))) (fun x => x (entry M (i, e)))).
  { apply mu_left. }
  { split; intros; try reflexivity. apply H. }
  { apply local_left. }
  { intros x x' E. apply E, L. }
  intros x Hx. destruct (entry_of M x _ Hx) as [a [u [Ha [Hu ->]]]].
  rewrite (mu_comm l _ _ _), (mu_unit l _ a u) by assumption.
  rewrite (sum_ext _ _ (fun p => (in_space (space_at M l) i a (fst p) * in_one (space_at M l) (fst p))
    * (in_field M e u (snd p) * (if Nat.eqb (snd p) 0 then 1 else 0)))).
  - unfold every. rewrite (sum_of_products _ _ (fun g => in_space (space_at M l)
    i a g * in_one (space_at M l) g)
      (fun h => in_field M e u h * (if Nat.eqb h 0 then 1 else 0))).
    rewrite (is_neutral _ _ _ (space_algebra (space_at M l)) i a) by assumption.
    rewrite (is_neutral _ _ _ field_algebra e u) by assumption.
    rewrite unit_at, entry_eq by assumption. destruct (Nat.eqb i a), (Nat.eqb e u); reflexivity.
  - intros [g h] I. unfold every in I. rewrite in_prod_iff, !in_seq in I. cbn [fst snd].
    rewrite (commutes _ _ _ (space_algebra (space_at M l)) i), (commutes _ _ _ field_algebra e).
    assert (E : oneof M l (entry M (g, h)) ==
      in_one (space_at M l) g * (if Nat.eqb h 0 then 1 else 0)).
    { unfold oneof, one_of, every, entry. cbn [fst snd]. fold (space_at M l).
    rewrite nth_entry by lia.
      unfold in_one. destruct (space_at M l); [destruct (Nat.eqb h 0); reflexivity|].
      destruct g, h; reflexivity. }
    rewrite E. ring.
Qed.
Lemma one_beyond l n : (dim M l <= n)%nat -> oneof M l n == 0.
Proof.
  intros H. unfold oneof. rewrite nth_overflow; [reflexivity|].
  unfold one_of, every. rewrite map_length, prod_length, !seq_length. exact H.
Qed.

(** A rational number times one of ℚ(θ). *)
Lemma rational_times e v : (e < degree M)%nat -> (v < degree M)%nat ->
  in_field M e 0 v == if Nat.eqb e v then 1 else 0.
Proof. intros He Hv. unfold in_field. rewrite Nat.add_0_l. apply power_small; assumption. Qed.
End Products.
